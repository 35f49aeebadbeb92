//! Knot vectors: checks, spans and basis functions of one parameter. No control points.

use super::{MAX_MAGNITUDE, MAX_ORDER, NurbsError};

/// A checked knot vector and its order.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Knots {
    values: Vec<f64>,
    order: usize,
    /// The spans of the domain that have a length: positions of their lower knots.
    spans: Vec<usize>,
}

/// Basis functions that do not vanish in a span, and their derivatives; `order` of each count.
pub(super) struct Basis {
    pub value: [f64; MAX_ORDER],
    pub derivative: [f64; MAX_ORDER],
}

impl Knots {
    /// The knots for `count` control points.
    pub fn new(values: Vec<f64>, count: usize) -> Result<Self, NurbsError> {
        let order = values.len().checked_sub(count).ok_or(NurbsError::Order)?;
        if !(2..=MAX_ORDER).contains(&order) || count < order {
            return Err(NurbsError::Order);
        }
        // NaN fails the comparison too.
        if !values.iter().all(|v| v.abs() <= MAX_MAGNITUDE) {
            return Err(NurbsError::Magnitude);
        }
        if values.windows(2).any(|w| w[1] < w[0]) {
            return Err(NurbsError::DecreasingKnots);
        }
        let spans: Vec<usize> = (order - 1..count)
            .filter(|&i| values[i] < values[i + 1])
            .collect();
        let too_often = values.windows(order + 1).any(|w| w[0] == w[order]);
        if too_often || spans.is_empty() {
            return Err(NurbsError::RepeatedKnots);
        }
        Ok(Self {
            values,
            order,
            spans,
        })
    }

    pub fn order(&self) -> usize {
        self.order
    }

    pub fn degree(&self) -> usize {
        self.order - 1
    }

    /// Number of control points.
    pub fn count(&self) -> usize {
        self.values.len() - self.order
    }

    pub fn spans(&self) -> &[usize] {
        &self.spans
    }

    pub fn domain(&self) -> (f64, f64) {
        (self.values[self.order - 1], self.values[self.count()])
    }

    /// The ends of a span.
    pub fn ends(&self, span: usize) -> (f64, f64) {
        (self.values[span], self.values[span + 1])
    }

    /// The first of the control points that count in a span.
    pub fn first_point(&self, span: usize) -> usize {
        span + 1 - self.order
    }

    /// Which of [`Self::spans`] holds `t`; of two that share it, the later. Values beyond the
    /// domain belong to its ends.
    pub fn span_index(&self, t: f64) -> usize {
        let after = self.spans.partition_point(|&s| self.values[s] <= t);
        after.saturating_sub(1)
    }

    /// How often the lower end of a span occurs.
    pub fn multiplicity_below(&self, span: usize) -> usize {
        let t = self.values[span];
        let (first, end) = (
            self.values.partition_point(|&v| v < t),
            self.values.partition_point(|&v| v <= t),
        );
        end - first
    }

    /// The basis functions at `t` in a span, its ends included: at a knot the limit from within
    /// the span. At an end of the domain that is repeated `order` times they are exactly 0 and 1.
    ///
    /// Source: Piegl and Tiller, *The NURBS Book*, 2nd ed., A2.2; the derivatives by eq. 2.7.
    pub fn basis(&self, span: usize, t: f64) -> Basis {
        let degree = self.degree();
        let mut value = [0.0; MAX_ORDER];
        let mut derivative = [0.0; MAX_ORDER];
        value[0] = 1.0;
        let knot = |i: usize| self.values[i];
        for d in 1..=degree {
            let last = d == degree;
            let mut saved = 0.0;
            let mut saved_slope = 0.0;
            for r in 0..d {
                // Both knots bound the span from different sides, so the width is positive.
                let (low, high) = (knot(span + 1 + r - d), knot(span + 1 + r));
                let part = value[r] / (high - low);
                if last {
                    let slope = degree as f64 * part;
                    derivative[r] = saved_slope - slope;
                    saved_slope = slope;
                }
                value[r] = saved + (high - t) * part;
                saved = (t - low) * part;
            }
            value[d] = saved;
            if last {
                derivative[d] = saved_slope;
            }
        }
        Basis { value, derivative }
    }

    /// The arguments of the polar form that give Bezier point `k` of a span: `degree - k` times its
    /// lower end, then `k` times its upper.
    fn argument(&self, span: usize, k: usize, r: usize) -> f64 {
        let (low, high) = self.ends(span);
        if r < self.degree() - k { low } else { high }
    }

    /// The factors of de Boor's scheme for Bezier point `k` of a span, into `combination`: the
    /// point is the sum of the span's control points times these.
    pub fn bezier_combination(&self, span: usize, k: usize, combination: &mut [f64; MAX_ORDER]) {
        let degree = self.degree();
        // Row i: what the i-th of the running points is made of.
        let mut rows = [[0.0; MAX_ORDER]; MAX_ORDER];
        for (i, row) in rows.iter_mut().enumerate().take(self.order) {
            row[i] = 1.0;
        }
        for r in 1..=degree {
            let t = self.argument(span, k, r - 1);
            for i in (r..=degree).rev() {
                let (low, high) = (
                    self.values[span + i - degree],
                    self.values[span + 1 + i - r],
                );
                let part = (t - low) / (high - low);
                let before = rows[i - 1];
                for (to, from) in rows[i].iter_mut().zip(before) {
                    *to = (1.0 - part) * from + part * *to;
                }
            }
        }
        *combination = rows[degree];
    }
}
