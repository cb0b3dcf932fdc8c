//! Charts of the largest multiplier, computed point by point, against the curves.

use harvester_lab::dynamics::largest_multipliers;
use harvester_lab::model::ForceLaw;

use super::support::*;

/// Cells of a chart along each side.
const CELLS: usize = 48;

#[test]
fn charts_computed_point_by_point_change_on_the_curves_and_only_there() -> TestResult {
    for (law, centre) in
        [(ForceLaw::Quadratic, 8.1565), (ForceLaw::Quadratic, 25.5148), (ForceLaw::Exact, 25.5148)]
    {
        let system = system(mild(1e-4), law)?;
        let window = chart((centre - 0.3, centre + 0.3), 0.03)?;
        let [omegas, betas] = [0, 1].map(|k| {
            let axis = window.axes()[k];
            (0..CELLS).map(|i| axis.at((i as f64 + 0.5) / CELLS as f64)).collect::<Vec<f64>>()
        });
        let mut stable = Vec::new();
        for omega in &omegas {
            let column = largest_multipliers(&system, *omega, &betas)?;
            stable.push(column.iter().map(|mu| mu.is_some_and(|mu| mu.norm() < 1.0)).collect::<Vec<bool>>());
        }
        let curve = only(curves(&system, &window)?)?;
        let cell = |at: [f64; 2]| {
            let [a, b] = [0, 1].map(|k| {
                let axis = window.axes()[k];
                (at[k] - axis.range.0) / axis.width() * CELLS as f64 - 0.5
            });
            (a, b)
        };
        // Every change between neighbours has the curve between or beside them.
        let near = |i: f64, j: f64| {
            curve.points.windows(2).any(|pair| {
                let ((a, b), (c, d)) = (cell(pair[0].at), cell(pair[1].at));
                (0..=8).any(|k| {
                    let t = f64::from(k) / 8.0;
                    (a + t * (c - a) - i).abs().max((b + t * (d - b) - j).abs()) <= 1.0
                })
            })
        };
        let mut changes = 0;
        for i in 0..CELLS {
            for j in 0..CELLS {
                for (k, l) in [(i + 1, j), (i, j + 1)] {
                    if k < CELLS && l < CELLS && stable[i][j] != stable[k][l] {
                        changes += 1;
                        assert!(
                            near((i + k) as f64 / 2.0, (j + l) as f64 / 2.0),
                            "{law:?} {centre}: {i} {j}"
                        );
                    }
                }
            }
        }
        assert!(changes > CELLS, "{changes}");
        // Every point of the curve has a change within a cell, where it is wider than the cells.
        for point in curve.points.iter().filter(|point| point.at[1] > betas[2]) {
            let (a, b) = cell(point.at);
            let within = 0.0..=(CELLS - 1) as f64;
            if !(within.contains(&a) && within.contains(&b)) {
                continue;
            }
            let range = |x: f64| ((x - 1.0).ceil().max(0.0) as usize)..=((x + 1.0) as usize).min(CELLS - 1);
            let around = range(a).flat_map(|i| range(b).map(move |j| (i, j)));
            let classes: Vec<bool> = around.map(|(i, j)| stable[i][j]).collect();
            assert!(classes.contains(&true) && classes.contains(&false), "{law:?} {centre}: {:?}", point.at);
        }
    }
    Ok(())
}
