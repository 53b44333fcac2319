//! Oracles of the elastica: elliptic integrals with 25 digits, and the tables printed in the literature (recalled: Mattiasson
//! 1981 and Bisshopp & Drucker 1945 for the cantilever, Timoshenko & Gere table 2-4 for the strut).

use super::super::elastica::{cantilever, end_moment, strut};
use super::{OracleRow, section};

/// Rows of [`super::super::elastica`].
pub fn rows() -> Vec<OracleRow> {
    [tip_force(), printed_tip_force(), buckled(), printed_buckled(), turned()].concat()
}

fn tip_force() -> Vec<OracleRow> {
    section(
        "elastica, cantilever",
        [
            ("v/L at FL²/B = 0.25", "0.0827459153544", cantilever(0.25).deflection),
            ("v/L at FL²/B = 1", "0.3017207738", cantilever(1.0).deflection),
            ("shortening at FL²/B = 1", "0.0564332362834", cantilever(1.0).shortening),
            ("θ at FL²/B = 1", "0.461351949712", cantilever(1.0).rotation),
            ("v/L at FL²/B = 2", "0.493457480397", cantilever(2.0).deflection),
            ("v/L at FL²/B = 5", "0.713791523612", cantilever(5.0).deflection),
            ("v/L at FL²/B = 10", "0.81060902488", cantilever(10.0).deflection),
            ("shortening at FL²/B = 10", "0.554995597754", cantilever(10.0).shortening),
            ("θ at FL²/B = 10", "1.4302855388", cantilever(10.0).rotation),
        ],
    )
}

fn printed_tip_force() -> Vec<OracleRow> {
    section(
        "elastica, cantilever, printed table",
        [
            ("v/L at FL²/B = 1", "0.30172", cantilever(1.0).deflection),
            ("v/L at FL²/B = 2", "0.49346", cantilever(2.0).deflection),
            ("shortening at FL²/B = 2", "0.16064", cantilever(2.0).shortening),
            ("θ at FL²/B = 2", "0.78175", cantilever(2.0).rotation),
            ("v/L at FL²/B = 5", "0.71379", cantilever(5.0).deflection),
            ("v/L at FL²/B = 10", "0.81061", cantilever(10.0).deflection),
            ("shortening at FL²/B = 10", "0.55500", cantilever(10.0).shortening),
        ],
    )
}

fn buckled() -> Vec<OracleRow> {
    let at = |degrees: f64| strut(degrees.to_radians());
    section(
        "elastica, buckled strut",
        [
            ("P/P_E at 20°", "1.01539686554", at(20.0).load),
            ("chord/L at 20°", "0.969730907364", at(20.0).chord),
            ("rise/L at 20°", "0.109706521198", at(20.0).rise),
            ("P/P_E at 60°", "1.15171962047", at(60.0).load),
            ("chord/L at 60°", "0.741019606076", at(60.0).chord),
            ("rise/L at 60°", "0.296603823082", at(60.0).rise),
            ("P/P_E at 120°", "1.88480086898", at(120.0).load),
            ("chord/L at 120°", "0.123159972405", at(120.0).chord),
            ("rise/L at 120°", "0.401585495004", at(120.0).rise),
            ("P/P_E at 160°", "4.03008596605", at(160.0).load),
            ("chord/L at 160°", "-0.340318855691", at(160.0).chord),
        ],
    )
}

/// The printed table is for a clamped column of half the length: its height is twice the rise, its length the chord.
fn printed_buckled() -> Vec<OracleRow> {
    let at = |degrees: f64| strut(degrees.to_radians());
    section(
        "elastica, buckled strut, printed table",
        [
            ("x/l at 20°", "0.970", at(20.0).chord),
            ("x/l at 40°", "0.881", at(40.0).chord),
            ("y/l at 40°", "0.422", 2.0 * at(40.0).rise),
            ("P/P_E at 60°", "1.152", at(60.0).load),
            ("y/l at 60°", "0.593", 2.0 * at(60.0).rise),
            ("x/l at 80°", "0.559", at(80.0).chord),
            ("y/l at 120°", "0.803", 2.0 * at(120.0).rise),
        ],
    )
}

fn turned() -> Vec<OracleRow> {
    section(
        "strip under an end moment",
        [
            ("v/L at a quarter turn", "0.636619772", end_moment(std::f64::consts::FRAC_PI_2).deflection),
            ("shortening at a quarter turn", "0.363380228", end_moment(std::f64::consts::FRAC_PI_2).shortening),
        ],
    )
}
