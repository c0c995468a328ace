//! Two units go in; what a value in one is multiplied by to be one in the other comes out.

/// Units by what they measure, each with its size in the first of its row.
const UNITS: [&[(&str, f64)]; 3] = [
    &[("m", 1.0), ("dm", 0.1), ("cm", 0.01), ("mm", 0.001)],
    &[("s", 1.0), ("ms", 0.001), ("min", 60.0)],
    &[("rad", 1.0), ("deg", std::f64::consts::PI / 180.0), ("°", std::f64::consts::PI / 180.0)],
];

/// What a value in one unit is multiplied by to be in the other; none where they measure different things. Where one of the two is not
/// known they are taken to be the same.
pub(super) fn factor(from: Option<&str>, to: Option<&str>) -> Option<f64> {
    let (Some(from), Some(to)) = (from, to) else { return Some(1.0) };
    if from == to {
        return Some(1.0);
    }
    UNITS.iter().find_map(|row| {
        let size = |unit: &str| row.iter().find(|(name, _)| *name == unit).map(|&(_, size)| size);
        Some(size(from)? / size(to)?)
    })
}

#[cfg(test)]
mod tests {
    use super::factor;

    #[test]
    fn centimetres_are_metres_and_no_seconds() {
        assert!((factor(Some("m"), Some("cm")).unwrap() - 100.0).abs() < 1e-12);
        assert_eq!(factor(Some("cm"), Some("s")), None);
        assert_eq!(factor(Some("cm"), None), Some(1.0));
        assert_eq!(factor(Some("furlong"), Some("furlong")), Some(1.0));
    }
}
