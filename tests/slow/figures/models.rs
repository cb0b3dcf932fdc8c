//! The operating points of the figures under the quadratic and the exact force law, with two and four modes.

use harvester_lab::scenario::ModelChoice;

use super::support::{assert_numbers, exact, run};
use crate::{OMEGA_1, OMEGA_2};

#[test]
fn the_last_tenth_under_three_models() {
    // From rest to t = 600. None of these motions is chaotic: two computations agree to many digits.
    for ([alpha, beta, omega], model, reference) in [
        (
            [1e-4, 1e-2, OMEGA_1 + OMEGA_2],
            ModelChoice::default(),
            [2.34916161401e1, 5.57464052635e1, 9.87165442197e2, 8.19075841202e-2, -8.53829402802e-2],
        ),
        (
            [1e-4, 1e-2, OMEGA_1 + OMEGA_2],
            exact(2),
            [1.66098137469e1, 2.52017990241e1, 6.10778912261e2, 1.67001996862e-2, -1.49008925213e-2],
        ),
        (
            [1e-4, 1e-2, OMEGA_1 + OMEGA_2],
            exact(4),
            [1.75136453635e1, 2.69248879470e1, 6.47202288234e2, 1.87984828948e-2, -1.64776460804e-2],
        ),
        (
            [1e-4, 1e-2, 2.0 * OMEGA_1],
            ModelChoice::default(),
            [1.41793010613e1, 2.55704127723e1, 1.24700323008e2, 6.67803810561e-2, -8.39676401562e-2],
        ),
        (
            [1e-4, 1e-2, 2.0 * OMEGA_1],
            exact(2),
            [1.26032512976e1, 2.30397564007e1, 1.11473160767e2, 9.32878366381e-2, -3.93679117696e-2],
        ),
        (
            [1e-4, 1e-2, 2.0 * OMEGA_1],
            exact(4),
            [1.25636687337e1, 2.29748949081e1, 1.10876312847e2, 9.34254551531e-2, -3.93676369079e-2],
        ),
        (
            [1e-4, 1e-2, 2.0 * OMEGA_2],
            exact(2),
            [2.64794020159e1, 4.72516964535e1, 5.70114647714e2, 1.98073944181e-1, -9.78585120401e-2],
        ),
        (
            [1e-4, 1e-2, 2.0 * OMEGA_2],
            exact(4),
            [9.56871900266, 1.41726124929e1, 5.80183793293e2, 3.22605964618e-3, -3.19433366974e-3],
        ),
        (
            [1e-3, 1e-3, 25.0],
            ModelChoice::default(),
            [1.82572918235, 2.58413474696, 6.45583618140e1, 1.41467187657e-3, -1.40549226624e-3],
        ),
        (
            [1e-3, 1e-3, 25.0],
            exact(2),
            [1.82573649990, 2.58419470618, 6.45581562737e1, 1.41428458899e-3, -1.40583684713e-3],
        ),
        (
            [1e-3, 1e-3, 25.0],
            exact(4),
            [1.90971375206, 2.70295410961, 6.75279598486e1, 1.48987799154e-3, -1.48019997109e-3],
        ),
    ] {
        assert_numbers(&run(alpha, beta, omega, 600.0, model), reference);
    }
}
