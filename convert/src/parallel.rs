//! Independent pieces of work on several threads, with results in order.

use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread;

/// Pieces taken at a time: meshes of CAD parts are small.
const CHUNK: usize = 32;

/// `work(i)` of all `i` below `count`, on at most `threads` threads. The results do not depend on
/// how many there are.
pub(crate) fn map<T: Send>(
    count: usize,
    threads: usize,
    work: impl Fn(usize) -> T + Sync,
) -> Vec<T> {
    let chunks = count.div_ceil(CHUNK);
    let threads = if count <= CHUNK {
        // Few pieces may be large ones.
        threads.min(count)
    } else {
        threads.min(chunks)
    };
    if threads <= 1 {
        return (0..count).map(work).collect();
    }
    let step = if count <= CHUNK { 1 } else { CHUNK };
    let next = AtomicUsize::new(0);
    let done = Mutex::new(Vec::new());
    let worker = || {
        loop {
            let start = next.fetch_add(step, Ordering::Relaxed);
            if start >= count {
                return;
            }
            let results: Vec<T> = (start..count.min(start + step)).map(&work).collect();
            if let Ok(mut done) = done.lock() {
                done.push((start, results));
            }
        }
    };
    thread::scope(|scope| {
        for _ in 1..threads {
            let spawned = thread::Builder::new().spawn_scoped(scope, worker);
            if spawned.is_err() {
                // The system gives no more threads: go on with those there are.
                break;
            }
        }
        worker();
    });
    let mut done = done.into_inner().unwrap_or_default();
    done.sort_unstable_by_key(|(start, _)| *start);
    done.into_iter().flat_map(|(_, results)| results).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn results_come_in_order_for_any_number_of_threads() {
        for count in [0, 1, 5, CHUNK, CHUNK + 1, 1000] {
            let want: Vec<usize> = (0..count).map(|i| i * i).collect();
            for threads in [0, 1, 2, 7] {
                assert_eq!(map(count, threads, |i| i * i), want, "{count} on {threads}");
            }
        }
    }
}
