use super::*;
use crate::dynamics::integration::linear::tests::{matrix, part, stiff};
use crate::dynamics::integration::node_map::NodeMap;
use crate::dynamics::integration::tables::StepTables;
use crate::model::ParameterSet;

// By tests/reference/propagator.py for [`stiff`] over STEP: what a unit of each component of the vector at the
// start, and then of R at each node, does to the state at the end; and to s, v and dv/dt at the fifth node.
const STEP: f64 = 0.3125;
#[rustfmt::skip]
const END: [[f64; 5]; 15] = [
    [0.319839327694219, 0.00184627884189995, -3.75716372184984, -0.00407696211534633, -4.71556478796255],
    [0.0497075072819217, 0.839436421881916, -0.10976436464394, 0.604130576955883, 2.69481443644714],
    [0.234822732615615, 0.000254810132209146, 0.304216505754806, 0.00211087306414247, 0.390165897353254],
    [0.000274410911609849, -0.00151032644238971, 0.00227324791523035, 0.841061876894035, 3.94531928413386],
    [-1.03152979736681e-9, 2.1895367296133e-11, -1.36558064073639e-9, -1.28222876734351e-8, -6.18114543517759e-8],
    [0.0632950610797856, -0.000382723705460955, 0.345027687861905, 0.00212514830017772, 0.441246487591002],
    [0.00700060287781025, -0.000610188270071717, 0.0632950610797856, -0.000382723705460955, 0.0773247648557351],
    [-0.01290433562243, 0.000332504546826459, -0.0183059087336902, -0.0431812495854479, -0.22529454490378],
    [-0.0271671270198301, 0.00299193055258766, -0.0521119789567937, -0.0781827439590464, -0.431620907009312],
    [-0.0346557980768072, 0.00701874874069339, -0.0991131546100209, -0.0129764254384826, -0.184717640464032],
    [-0.0330755487139159, 0.00452602048134444, -0.145726220627454, 0.137660692187301, 0.463128256091603],
    [-0.0239645123321853, -0.00462343391559622, -0.170761505368289, 0.145945516260757, 0.470665868941689],
    [-0.0124322980212053, -0.00754818126972894, -0.161773328663762, -0.0078229620716179, -0.238886862886001],
    [-0.00383846848138119, -0.00328123969403192, -0.119723378905112, -0.0868306696418156, -0.556675612947209],
    [-0.000343185302469017, -0.000317055017638683, -0.0552559237522632, -0.0505954322766136, -0.306232986893633],
];
#[rustfmt::skip]
const FIFTH_NODE: [[f64; 3]; 15] = [
    [0.741197808933307, -3.29472891709686, -15.0208894759694],
    [-0.741212740901449, 45.0017836314855, 1410.15657500726],
    [0.166759621772616, 0.93880559224809, -2.69996526275253],
    [-0.0245820195325594, -3.52539143751815, 48.7267224735032],
    [-3.55082458609119e-10, 4.9599933765531e-8, -7.3050675841097e-7],
    [0.0209492170271186, 0.393165328157563, 4.03792976590101],
    [0.00114578952944341, 0.0143222006097354, 0.393165328157563],
    [-0.00797017462545477, 0.148400842573647, -1.90783207008917],
    [-0.0175683808474765, 0.340534099366203, 0.447341165668766],
    [-0.0241751738388523, 0.300392714013095, 11.0573966189674],
    [-0.0189734721404384, -0.660673656611937, 15.7355362295204],
    [-0.00227270060508785, -0.549177598243152, -16.890003720119],
    [0.000251117865864741, 0.0905526239786241, -0.351631462178138],
    [-6.53092853115483e-5, -0.0336015721157676, 0.1047257502102],
    [1.37606610932621e-5, 0.00849008843016913, -0.0238299129147521],
];

/// Whether `value` is the reference up to rounding, some of it of the size `lost`.
fn assert_close(value: f64, reference: f64, lost: f64, place: (usize, usize)) {
    let error = (value - reference).abs();
    assert!(error <= 1e-13 * reference.abs() + 1e-15 * lost, "{place:?}: {value} instead of {reference}");
}

#[test]
fn a_circuit_ten_million_times_faster_than_the_beam_costs_no_digits() {
    let tables = StepTables::new(&stiff(), STEP);
    for (j, references) in END.iter().enumerate() {
        for (i, reference) in references.iter().enumerate() {
            // What is left of a voltage is known relative to what it was.
            let lost = if (i, j) == (4, 4) { 1.0 } else { 0.0 };
            assert_close(tables.end_column(j)[i], *reference, lost, (i, j));
        }
    }
    let entry = |map: &NodeMap, j: usize| map.from_state.get(j).unwrap_or_else(|| &map.from_rest[j - 7])[4];
    for (j, [tip, voltage, rate]) in FIFTH_NODE.into_iter().enumerate() {
        assert_close(entry(&tables.tip, j), tip, 0.01, (0, j));
        assert_close(entry(&tables.voltage, j), voltage, 0.0, (1, j));
        // The difference of two currents that the voltage keeps in balance.
        assert_close(entry(&tables.voltage_rate, j), rate, 1e7 * voltage.abs(), (2, j));
    }
}

#[test]
fn dense_output_is_the_same_motion() {
    let (part, duration) = (stiff(), STEP);
    let propagator = Propagator::new(&part, duration);
    let start = [0.01, -0.02, 0.1, 0.4, 3.0, 0.6, 0.8];
    let rest = RULE.nodes.map(|x| (5.0 * x).cos());
    let tables = StepTables::of(&propagator);
    let mut end = vec![0.0; tables.stride()];
    tables.end(&start, &rest, &mut end);
    let tip = tables.tip.at_nodes(&start, &rest);
    let input = StepRest::new(&rest, duration);
    // In one go, through all nodes, and at last over a short rest.
    for stops in [vec![1.0], [&RULE.nodes[..], &[1.0 - 1e-8, 1.0]].concat()] {
        let (mut y, mut reached) = (start.to_vec(), 0.0);
        for (i, stop) in stops.iter().map(|stop| stop * duration).enumerate() {
            propagator.carry(&mut y, reached, stop, &input, &mut Workspace::default());
            reached = stop;
            if stops.len() > 1 && i < NODES {
                assert_close(y[0] + y[1], tip[i], 1.0, (i, 0));
            }
        }
        for (i, (value, end)) in y.iter().zip(&end[..5]).enumerate() {
            assert_close(*value, *end, 10.0, (i, 0));
        }
    }
}

#[test]
fn it_agrees_with_the_matrix_exponential() {
    let set = ParameterSet { beta: 0.01, ..Default::default() };
    for modes in [1, 2, 8] {
        let part = part(set, modes);
        // In components of comparable energy, which the library's exponential needs more than ours.
        let size = part.extended_dimension();
        let scales = nalgebra::DVector::from_fn(size, |i, _| match i {
            i if i < modes => 1.0,
            i if i < 2 * modes => part.frequency(i - modes),
            i if i == 2 * modes => 2000.0,
            _ => 100.0,
        });
        let start = nalgebra::DVector::from_fn(size, |i, _| (i as f64 + 1.0).sin());
        let balanced =
            nalgebra::DMatrix::from_fn(size, size, |i, j| matrix(&part)[(i, j)] * scales[j] / scales[i]);
        let expected = (balanced * 0.7).exp() * &start;
        let mut y: Vec<f64> = start.component_mul(&scales).iter().copied().collect();
        let rest = StepRest::new(&[0.0; NODES], 0.7);
        Propagator::new(&part, 0.7).carry(&mut y, 0.0, 0.7, &rest, &mut Workspace::default());
        let reached = nalgebra::DVector::from_vec(y).component_div(&scales);
        let error = (reached - &expected).amax() / expected.amax();
        assert!(error < 3e-14, "{modes} modes: {error:e}");
    }
}

#[test]
fn a_polynomial_rest_force_acts_like_many_short_constant_ones() {
    let part = part(ParameterSet::default(), 2);
    let polynomial = |t: f64| 0.3 - 2.0 * t + 5.0 * t * t + t.powi(3);
    let step = 0.2;
    let propagator = Propagator::new(&part, step);
    let mut once = vec![0.01, 0.0, 0.0, 0.1, 1.0, 0.0, 1.0];
    let mut often = once.clone();
    let mut workspace = Workspace::default();
    let rest = StepRest::new(&RULE.nodes.map(|x| polynomial(step * x)), step);
    propagator.carry(&mut once, 0.0, step, &rest, &mut workspace);
    // Midpoint values of R on 4,000 intervals: an independent second-order method.
    let count = 4000;
    let short = step / f64::from(count);
    for i in 0..count {
        let rest = StepRest::new(&[polynomial(short * (f64::from(i) + 0.5)); NODES], short);
        propagator.carry(&mut often, 0.0, short, &rest, &mut workspace);
    }
    for (a, b) in once.iter().zip(&often) {
        assert!((a - b).abs() < 1e-7 * (1.0 + b.abs()), "{a} {b}");
    }
}
