//! The nodes of a table around a point.

/// A point on an axis: the nodes below and above it, and its fraction between them.
#[derive(Clone, Copy, Debug)]
pub(super) struct AxisInterval {
    low: usize,
    high: usize,
    part: f64,
}

impl AxisInterval {
    /// The interval of `nodes` that contains `x`.
    pub(super) fn of<T: Copy + Into<f64>>(x: f64, nodes: &[T]) -> Self {
        let high =
            nodes.partition_point(|node| (*node).into() < x).clamp(1, nodes.len().max(2) - 1);
        let (low, high) = (high - 1, high.min(nodes.len() - 1));
        let (a, b): (f64, f64) = (nodes[low].into(), nodes[high].into());
        let part = if b > a { ((x - a) / (b - a)).clamp(0.0, 1.0) } else { 0.0 };
        Self { low, high, part }
    }
}

/// The nodes around a point with their weights; nodes of weight 0 are omitted, so that a node gives
/// its own value.
pub(super) fn corners<const N: usize>(
    intervals: [AxisInterval; N],
) -> impl Iterator<Item = ([usize; N], f64)> {
    (0..1_usize << N).filter_map(move |bits| {
        let upper = |axis: usize| bits >> axis & 1 == 1;
        let weight = (0..N)
            .map(|axis| if upper(axis) { intervals[axis].part } else { 1.0 - intervals[axis].part })
            .product::<f64>();
        let node = std::array::from_fn(|axis| match upper(axis) {
            true => intervals[axis].high,
            false => intervals[axis].low,
        });
        (weight > 0.0).then_some((node, weight))
    })
}
