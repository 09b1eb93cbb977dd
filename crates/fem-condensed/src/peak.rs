//! The largest value of a history.

/// Largest value of a smooth function given at even steps: the vertex of the parabola through the
/// highest three.
#[derive(Debug, Default)]
pub(crate) struct Peak {
    last: [f64; 2],
    /// So far.
    pub highest: f64,
}

impl Peak {
    /// Takes the next value.
    pub fn observe(&mut self, value: f64) {
        let [before, middle] = self.last;
        if middle >= before && middle > value {
            let (slope, bend) = (0.5 * (value - before), value - 2.0 * middle + before);
            self.highest = self.highest.max(middle - 0.5 * slope * slope / bend);
        }
        self.highest = self.highest.max(value);
        self.last = [middle, value];
    }
}
