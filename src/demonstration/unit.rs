//! Units of other people's columns, as factors to SI.

/// (unit, what it measures, factor to the SI unit of that quantity).
const UNITS: [(&str, &str, f64); 26] = [
    ("m", "m", 1.0),
    ("km", "m", 1e3),
    ("cm", "m", 1e-2),
    ("mm", "m", 1e-3),
    ("um", "m", 1e-6),
    ("in", "m", 0.0254),
    ("rad", "rad", 1.0),
    ("mrad", "rad", 1e-3),
    ("deg", "rad", std::f64::consts::PI / 180.0),
    ("s", "s", 1.0),
    ("min", "s", 60.0),
    ("ms", "s", 1e-3),
    ("us", "s", 1e-6),
    ("ns", "s", 1e-9),
    ("kg", "kg", 1.0),
    ("g", "kg", 1e-3),
    ("N", "n", 1.0),
    ("n", "n", 1.0),
    ("kN", "n", 1e3),
    ("mN", "n", 1e-3),
    ("Nm", "nm", 1.0),
    ("nm", "nm", 1.0),
    ("mNm", "nm", 1e-3),
    ("Nmm", "nm", 1e-3),
    ("1", "", 1.0),
    ("percent", "", 1e-2),
];

/// The factor that brings `unit` to the SI unit at the end of `column`, e.g. 0.001 for `x_m` from `mm`; else what was expected.
pub(super) fn factor(unit: &str, column: &str) -> Result<f64, String> {
    let known = || UNITS.iter().map(|(name, ..)| *name).collect::<Vec<_>>().join(", ");
    let (_, quantity, factor) = UNITS.iter().find(|(name, ..)| *name == unit).ok_or_else(|| format!("one of {}", known()))?;
    let target = if *quantity == "" { "" } else { column.rsplit_once('_').map_or("", |(_, unit)| unit) };
    if target == *quantity { Ok(*factor) } else { Err(format!("a column whose name ends with _{quantity}, in which {unit} is counted")) }
}
