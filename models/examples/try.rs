use models::*;
fn main() {
    for (name, text) in scenario::SHIPPED {
        let sc = Scenario::parse(text).unwrap();
        for variant in [sc.clone(), sc.with_effect("end_constraint", &[0.142*std::f64::consts::PI])] {
        let m = Model::new(&variant);
        let mut p = m.prediction();
        for pr in [10e3, 20e3, 30e3] {
            m.predict(&Loads::uniform(2e3, pr), &mut p).unwrap();
            print!("{name} {pr}: y6 {:.4} tip {:.4} ", p.markers[5][1]*1e3, p.tip.y_m*1e3);
        }
        println!("{:?}", m.ledger(&Loads::uniform(2e3,30e3), &p));
        }
        let g = sc.with_effect("gravity",&[1.5]).with_effect("tip_load",&[0.0,-0.1]);
        let m = Model::new(&g);
        let mut p = m.prediction();
        for pr in [10e3, 20e3, 30e3] {
            match m.predict(&Loads::uniform(2e3, pr), &mut p) { Ok(()) => print!("{name} {pr}: y6 {:.4} ", p.markers[5][1]*1e3), Err(e)=>print!("{e}") }
        }
        println!();
        let m = Model::new(&sc);
        let mut p = m.prediction();
        println!("{:?} {:?}", m.pressure_for(Target::TipHeight(0.1), 2e3, &mut p), m.pressure_for(Target::TipHeight(0.3), 2e3, &mut p));
        let n = 200000;
        let t = std::time::Instant::now();
        let mut acc = 0.0;
        for i in 0..n { m.predict(&Loads::uniform(2e3, 10e3 + 20e3*(i as f64/n as f64)), &mut p).unwrap(); acc += p.markers[5][1]; }
        println!("{name} {:.3} us/pred {acc}", t.elapsed().as_secs_f64()/n as f64*1e6);
        let m2 = Model::new(&g); let mut p2 = m2.prediction();
        let t = std::time::Instant::now();
        let n=2000;
        for i in 0..n { let _ = m2.predict(&Loads::uniform(2e3, 10e3 + 20e3*(i as f64/n as f64)), &mut p2); acc += p2.markers[5][1]; }
        println!("{name} loaded {:.3} us/pred {acc}", t.elapsed().as_secs_f64()/n as f64*1e6);
        let t = std::time::Instant::now();
        for i in 0..n { let _ = m.pressure_for(Target::TipHeight(0.02+0.02*(i as f64/n as f64)), 2e3, &mut p);  acc += p.markers[5][1]; }
        println!("{name} inverse {:.3} us {acc}", t.elapsed().as_secs_f64()/n as f64*1e6);
    }
    // discovery base
    for (name, arm, b, gain) in [("spam",85.0,6.0,1.0),("epam",80.0,1.35,1.0),("cpam",80.0,0.9,1.8),("fpam",99.0,0.3,1.0)] {
        let mut sc = Scenario::parse(shipped(name).unwrap()).unwrap().bare().with_bending(b);
        sc.actuator.arm_m = Some(arm*1e-3); sc.actuator.shape.volume_gain = gain;
        let m = Model::new(&sc); let mut p = m.prediction();
        for pr in [10e3, 20e3, 30e3] { m.predict(&Loads::uniform(2e3, pr), &mut p).unwrap(); print!("{:.2} ", p.markers[5][1]*1e3); }
        println!("{name}");
    }
}
