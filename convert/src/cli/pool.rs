//! Independent pieces of work on several threads, with results in order.

use std::any::Any;
use std::cell::RefCell;
use std::io::{self, IsTerminal};
use std::panic::{self, AssertUnwindSafe};
use std::sync::Once;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc::{self, RecvTimeoutError};
use std::thread;
use std::time::Duration;

/// Time between two ticks.
const TICK: Duration = Duration::from_millis(100);

/// What the calling thread is told.
#[derive(Debug, PartialEq, Eq)]
pub enum Event<T> {
    /// Time has passed, or a piece is finished.
    Tick {
        /// Pieces finished so far, in any order.
        finished: usize,
    },
    /// The next result in order.
    Next {
        /// Which piece.
        index: usize,
        /// Its result, or the words of its panic.
        result: Result<T, String>,
    },
}

/// Calls `work(0)` to `work(count - 1)` on at most `jobs` threads, and `on` in the calling thread
/// with the results in order, each as soon as it and all before it are there. A panic in `work`
/// costs that piece only.
pub fn run<T: Send>(
    count: usize,
    jobs: usize,
    work: impl Fn(usize) -> T + Sync,
    mut on: impl FnMut(Event<T>),
) {
    // With nobody to watch, a single piece stays on this thread, whose memory grows more cheaply.
    if count == 1 && !io::stderr().is_terminal() {
        let result = caught(|| work(0));
        on(Event::Tick { finished: 1 });
        on(Event::Next { index: 0, result });
        return;
    }
    let next = AtomicUsize::new(0);
    let (sender, receiver) = mpsc::channel();
    let worker = |sender: mpsc::Sender<(usize, Result<T, String>)>| {
        loop {
            let index = next.fetch_add(1, Ordering::Relaxed);
            if index >= count {
                return;
            }
            // Nobody listens any more only when the caller is unwinding.
            let _ = sender.send((index, caught(|| work(index))));
        }
    };
    thread::scope(|scope| {
        let mut started = 0;
        for _ in 0..jobs.min(count) {
            let sender = sender.clone();
            let worker = &worker;
            let thread = thread::Builder::new().spawn_scoped(scope, move || worker(sender));
            if thread.is_err() {
                // The system gives no more threads: go on with those there are.
                break;
            }
            started += 1;
        }
        if started == 0 {
            worker(sender.clone());
        }
        drop(sender);
        let mut waiting: Vec<Option<Result<T, String>>> = (0..count).map(|_| None).collect();
        let (mut finished, mut told) = (0, 0);
        while told < count {
            match receiver.recv_timeout(TICK) {
                Ok((index, result)) => {
                    waiting[index] = Some(result);
                    finished += 1;
                }
                Err(RecvTimeoutError::Timeout) => {}
                Err(RecvTimeoutError::Disconnected) => break,
            }
            on(Event::Tick { finished });
            while let Some(result) = waiting.get_mut(told).and_then(Option::take) {
                on(Event::Next {
                    index: told,
                    result,
                });
                told += 1;
            }
        }
    });
}

thread_local! {
    /// `Some` while a piece of work runs on this thread: the place of its panic, once there is one.
    static PANIC_PLACE: RefCell<Option<String>> = const { RefCell::new(None) };
}

/// The result of `work`, or the words and the place of its panic.
fn caught<T>(work: impl FnOnce() -> T) -> Result<T, String> {
    keep_panics_quiet();
    PANIC_PLACE.set(Some(String::new()));
    // A piece of work shares nothing that it changes.
    let result = panic::catch_unwind(AssertUnwindSafe(work));
    let place = PANIC_PLACE.take().unwrap_or_default();
    result.map_err(|payload| format!("{}{place}", words(payload.as_ref())))
}

fn words(payload: &(dyn Any + Send)) -> &str {
    let text = payload.downcast_ref::<String>().map(String::as_str);
    text.or_else(|| payload.downcast_ref::<&str>().copied())
        .unwrap_or("no message")
}

/// Panics of work are reported with the input they belong to and not printed on their own.
fn keep_panics_quiet() {
    static ONCE: Once = Once::new();
    ONCE.call_once(|| {
        let other = panic::take_hook();
        panic::set_hook(Box::new(move |info| {
            let is_work = PANIC_PLACE.with_borrow_mut(|place| {
                let at = info.location().map(|l| format!(" at {l}"));
                place
                    .as_mut()
                    .map(|p| *p = at.unwrap_or_default())
                    .is_some()
            });
            if !is_work {
                other(info);
            }
        }));
    });
}

#[cfg(test)]
mod tests {
    use super::*;

    fn results(count: usize, jobs: usize) -> Vec<(usize, Result<usize, String>)> {
        let work = |i: usize| {
            // The first pieces take longest, so that results come out of order.
            thread::sleep(Duration::from_millis(5 * (count - i) as u64));
            assert!(i % 3 != 1, "piece {i}");
            i * i
        };
        let mut got = Vec::new();
        run(count, jobs, work, |event| {
            if let Event::Next { index, result } = event {
                got.push((index, result));
            }
        });
        got
    }

    #[test]
    fn results_come_in_order_and_panics_stay_with_their_piece() {
        for (count, jobs) in [(0, 1), (1, 8), (7, 1), (7, 3), (7, 100)] {
            let got = results(count, jobs);
            assert_eq!(got.len(), count);
            for (i, (index, result)) in got.into_iter().enumerate() {
                assert_eq!(index, i);
                match result {
                    Ok(square) => assert_eq!(square, i * i),
                    Err(why) => {
                        assert_eq!(i % 3, 1);
                        assert!(why.starts_with(&format!("piece {i} at ")), "{why}");
                        assert!(why.contains("pool.rs"), "{why}");
                    }
                }
            }
        }
    }
}
