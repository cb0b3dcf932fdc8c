//! Section 5.4 and the model's own limits: the highest voltage of the ceramic, the distance at which the magnets touch,
//! and the deflection up to which linear beam theory holds.
//!
//! The fields of section 5.4 are given in V per mil of an alternating voltage, without a word whether its peak or its
//! root mean square is meant. They are read as peaks, and the motion's largest |v| is held against them: were they root
//! mean squares, the limit would be 1.41 times higher for a sine. So the reading errs to the safe side.

use serde::{Deserialize, Serialize};

use super::materials::METRES_PER_MIL;
use super::{Device, ModelError};

/// Tip displacement, in beam lengths, beyond which the beam is no linear one.
pub const LINEAR_BEAM: f64 = 0.3;
/// Slope at the tip (rad) beyond which it is none: there the arc is 4.5 % longer than its projection.
pub const LINEAR_SLOPE: f64 = 0.3;

/// What is limited.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum LimitKind {
    /// Largest |v| against the field that the ceramic bears (V).
    Voltage,
    /// How much of the gap s0 the tip closes (dimensionless); at 1 the magnets touch.
    Gap,
    /// Largest tip displacement from equilibrium over the beam's length (dimensionless).
    Deflection,
    /// Largest slope at the tip, measured from equilibrium (rad).
    Slope,
    /// Sag of the tip under gravity over the beam's length (dimensionless): the model counts it as small.
    Sag,
}

/// How a value stands to its limit.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Standing {
    /// Below the limit.
    Within,
    /// Within the published range of the limit, so that it depends on the piece.
    Marginal,
    /// Beyond it.
    Exceeded,
}

/// What can be said of a motion and the limits of its device, the worst first.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Assessment {
    /// The motion ends, or a limit is exceeded.
    Exceeded,
    /// The voltage lies within the published range of its limit.
    Marginal,
    /// What is checked is kept, but the beam sags too much for the model to be valid.
    ModelNotValid,
    /// What is checked is kept, but no limit is known for the voltage.
    Unchecked,
    /// Every limit is known and kept.
    WithinLimits,
}

impl Assessment {
    /// Of `checks` by `limits`, with the beam's `sag`.
    pub fn of(checks: &[Check], limits: &Limits, sag: &Check) -> Self {
        let some = |standing| checks.iter().any(|check| check.standing == standing);
        if checks.is_empty() || some(Standing::Exceeded) {
            Self::Exceeded
        } else if some(Standing::Marginal) {
            Self::Marginal
        } else {
            Self::of_kept(limits, sag)
        }
    }

    /// Where every limit that is known is kept.
    pub fn of_kept(limits: &Limits, sag: &Check) -> Self {
        if sag.standing != Standing::Within {
            Self::ModelNotValid
        } else if limits.voltage.is_none() {
            Self::Unchecked
        } else {
            Self::WithinLimits
        }
    }
}

/// One limit, checked.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Check {
    /// What is limited.
    pub kind: LimitKind,
    /// The value, in the unit that [`LimitKind`] names.
    pub value: f64,
    /// Its limit; the lower end where a range is published.
    pub limit: f64,
    /// What is left, 1 - value / limit (dimensionless); negative beyond the limit.
    pub margin: f64,
    /// The same in a word.
    pub standing: Standing,
}

impl Check {
    fn new(kind: LimitKind, value: f64, (limit, most): (f64, f64)) -> Self {
        // Written so that NaN exceeds; the voltage just at the limit is allowed, the magnets just touching are not.
        let standing = if value < limit || (value == limit && kind != LimitKind::Gap) {
            Standing::Within
        } else if value <= most && kind == LimitKind::Voltage {
            Standing::Marginal
        } else {
            Standing::Exceeded
        };
        Self { kind, value, limit, margin: 1.0 - value / limit, standing }
    }
}

/// What a motion asks of the device.
#[derive(
    Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize, nanoserde::SerBin, nanoserde::DeBin,
)]
pub struct Demand {
    /// Largest |v| (V).
    pub v_peak: f64,
    /// Lowest and highest tip displacement from equilibrium, in beam lengths.
    pub tip: (f64, f64),
    /// Largest |slope| at the tip (rad), where it is known.
    pub slope: Option<f64>,
}

/// The limits of a device.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, nanoserde::SerBin, nanoserde::DeBin)]
#[serde(default, deny_unknown_fields)]
pub struct Limits {
    /// Lower and upper end of the range published for the largest voltage (V); none when no ceramic is chosen, or
    /// nothing is published for it. A peak: the largest |v| of the motion is held against it.
    pub voltage: Option<(f64, f64)>,
    /// Part of the gap s0 that the tip may close (dimensionless), at most 1.
    pub gap: f64,
    /// Largest tip displacement, in beam lengths.
    pub deflection: f64,
    /// Largest slope at the tip (rad).
    pub slope: f64,
}

impl Default for Limits {
    /// Contact, and the linear beam; no ceramic.
    fn default() -> Self {
        Self { voltage: None, gap: 1.0, deflection: LINEAR_BEAM, slope: LINEAR_SLOPE }
    }
}

impl Limits {
    /// Section 5.4: the limits of `device`, whose ceramic of its thickness bears the published field. Of plates in series, whose
    /// voltages add, each has its part of the voltage.
    pub fn of(device: &Device) -> Self {
        let plates = device.layers.map_or(1, |layers| layers.plates_in_series());
        let mils = f64::from(plates) * device.ceramic_thickness / METRES_PER_MIL;
        let field = device.ceramic.and_then(|ceramic| ceramic.material().field_limit);
        Self { voltage: field.map(|(low, high)| (low * mils, high * mils)), ..Self::default() }
    }

    /// These for `device`: the voltage, where none is given, is the one that its ceramic bears.
    #[must_use]
    pub fn completed(self, device: &Device) -> Self {
        Self { voltage: self.voltage.or(Self::of(device).voltage), ..self }
    }

    /// Checks that the limits can be kept at all.
    ///
    /// # Errors
    /// [`ModelError`] naming what is out of range.
    pub fn validate(&self) -> Result<(), ModelError> {
        let positive = (1e-12, 1e12);
        ModelError::check("limits.gap", self.gap, (positive.0, 1.0), "")?;
        ModelError::check("limits.deflection", self.deflection, positive, "")?;
        ModelError::check("limits.slope", self.slope, positive, "")?;
        if let Some((low, high)) = self.voltage {
            ModelError::check("limits.voltage", low, positive, " V")?;
            ModelError::check("limits.voltage", high, (low, positive.1), " V")?;
        }
        Ok(())
    }

    /// Every limit that applies to `demand`. `gap` is s0 in beam lengths; `None` without magnets, which then cannot
    /// touch.
    pub fn checks(&self, demand: &Demand, gap: Option<f64>) -> Vec<Check> {
        let exactly = |limit: f64| (limit, limit);
        let (low, high) = demand.tip;
        // Written so that NaN stays NaN, and exceeds.
        let closing = if low > 0.0 { 0.0 } else { -low };
        let farthest = if -low > high { -low } else { high };
        let mut checks = Vec::with_capacity(4);
        checks.extend(self.voltage.map(|range| Check::new(LimitKind::Voltage, demand.v_peak, range)));
        checks.extend(gap.map(|gap| Check::new(LimitKind::Gap, closing / gap, exactly(self.gap))));
        checks.push(Check::new(LimitKind::Deflection, farthest, exactly(self.deflection)));
        checks.extend(demand.slope.map(|slope| Check::new(LimitKind::Slope, slope, exactly(self.slope))));
        checks
    }

    /// Whether `demand` keeps all limits, a marginal voltage counted as not kept.
    pub fn allow(&self, demand: &Demand, gap: Option<f64>) -> bool {
        self.checks(demand, gap).iter().all(|check| check.standing == Standing::Within)
    }
}

/// The sag of `device` under gravity against the deflection of a linear beam: no limit of its motion, but the model
/// counts it as small.
pub fn sag(device: &Device) -> Check {
    Check::new(LimitKind::Sag, device.sag() / device.beam_length, (LINEAR_BEAM, LINEAR_BEAM))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::materials::Ceramic;

    #[test]
    fn the_ceramics_thickness_times_the_published_field_is_its_voltage() {
        // 0.254 mm are 10 mil: 5-7 V/mil are 50 to 70 V.
        let device =
            Device { ceramic_thickness: 2.54e-4, ceramic: Some(Ceramic::Apc855), ..Default::default() };
        let limits = Limits::of(&device);
        let (low, high) = limits.voltage.expect("published");
        assert!((low - 50.0).abs() < 1e-12 && (high - 70.0).abs() < 1e-12);
        for (v_peak, standing) in
            [(49.0, Standing::Within), (60.0, Standing::Marginal), (71.0, Standing::Exceeded)]
        {
            let demand = Demand { v_peak, ..Default::default() };
            let check = limits.checks(&demand, None)[0];
            assert_eq!((check.kind, check.standing), (LimitKind::Voltage, standing));
            assert!((check.margin - (1.0 - v_peak / 50.0)).abs() < 1e-12);
            assert_eq!(limits.allow(&demand, None), standing == Standing::Within);
        }
        assert_eq!(Limits::of(&Device { ceramic: Some(Ceramic::Apc860), ..device }).voltage, None);
    }

    #[test]
    fn every_limit_changes_the_verdict_when_it_is_violated() {
        let limits = Limits { voltage: Some((10.0, 12.0)), gap: 0.8, ..Default::default() };
        let good = Demand { v_peak: 9.0, tip: (-0.1, 0.2), slope: Some(0.2) };
        assert!(limits.allow(&good, Some(0.17)));
        for (kind, bad) in [
            (LimitKind::Voltage, Demand { v_peak: 10.5, ..good }),
            (LimitKind::Gap, Demand { tip: (-0.14, 0.2), ..good }),
            (LimitKind::Deflection, Demand { tip: (-0.1, 0.31), ..good }),
            (LimitKind::Slope, Demand { slope: Some(0.31), ..good }),
            (LimitKind::Slope, Demand { slope: Some(f64::NAN), ..good }),
            (LimitKind::Voltage, Demand { v_peak: f64::NAN, ..good }),
            (LimitKind::Gap, Demand { tip: (f64::NAN, 0.2), ..good }),
            (LimitKind::Deflection, Demand { tip: (-0.1, f64::NAN), ..good }),
        ] {
            assert!(!limits.allow(&bad, Some(0.17)), "{kind:?}");
            let broken =
                limits.checks(&bad, Some(0.17)).into_iter().filter(|c| c.standing != Standing::Within);
            assert_eq!(broken.map(|check| check.kind).collect::<Vec<_>>(), [kind]);
        }
        // Without magnets there is nothing to touch.
        assert!(limits.allow(&Demand { tip: (-0.2, 0.2), ..good }, None));
    }

    #[test]
    fn the_papers_own_beam_sags_by_more_than_half_its_length() {
        let check = sag(&Device::default());
        assert!(check.value > 0.55 && check.standing == Standing::Exceeded, "{check:?}");
    }
}
