use harvester_lab::model::*;
use harvester_lab::theory::*;
#[test]
fn table() {
    for (alpha, omega, r) in [
        (1e-4, 8.1569, Resonance::First),
        (1e-4, 8.0969, Resonance::First),
        (1e-4, 25.5047, Resonance::Sum),
        (1e-4, 25.4047, Resonance::Sum),
        (1e-4, 25.3047, Resonance::Sum),
        (1e-4, 42.8725, Resonance::Second),
        (1e-3, 8.1569, Resonance::First),
        (1e-3, 25.5047, Resonance::Sum),
    ] {
        let p = Parameters::new(ParameterSet { alpha, ..Default::default() }).unwrap();
        let s = ReducedSystem::new(p, 2, ForceLaw::Quadratic).unwrap();
        let c = CoupledModes::new(&s).unwrap();
        let q = Published::new(&s).unwrap();
        println!(
            "{alpha} {omega} coupled {:?} published {:?} diff {:?}",
            c.boundary(r, omega),
            q.boundary(r, omega),
            c.difference_coupling(0, 1, 17.3)
        );
        println!("{:?}", c.eigenvalues());
        println!("{:?}", c.modes());
    }
    let p = Parameters::new(ParameterSet { alpha: 1e-4, ..Default::default() }).unwrap();
    for n in [2, 4, 8] {
        let s = ReducedSystem::new(p, n, ForceLaw::Quadratic).unwrap();
        let t = std::time::Instant::now();
        for _ in 0..1000 {
            std::hint::black_box(CoupledModes::new(&s).unwrap());
        }
        let a = t.elapsed() / 1000;
        let c = CoupledModes::new(&s).unwrap();
        let t = std::time::Instant::now();
        for k in 0..10000 {
            std::hint::black_box(c.boundary(Resonance::Sum, 25.0 + 1e-4 * k as f64));
        }
        println!("{n}: new {a:?} boundary {:?}", t.elapsed() / 10000);
    }
}
