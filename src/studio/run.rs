//! One finite element run at a time, started by a page.

use crate::studies::SMALL_RUN;
use fem::FemError;
use fem::robot::Reading;
use fem::session::{FeRun, RunSettings, RunSource, simulate};
use serde::Deserialize;
use serde_json::{Value, json};
use std::ops::ControlFlow;
use std::sync::{Arc, Mutex, PoisonError};

/// Stack of a run, as much as a program has: set-up and pictures need more than a thread is given.
const STACK: usize = 16 << 20;

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct RunRequest {
    name: String,
    text: String,
    actuator_kpa: f64,
}

#[derive(Debug, Default)]
struct Stand {
    told: Option<Value>,
    runs: bool,
    stop: bool,
}

#[derive(Default)]
pub(super) struct SharedStand {
    stand: Arc<Mutex<Stand>>,
}

/// The stand; a thread that panicked has reported that already.
fn of(stand: &Mutex<Stand>) -> std::sync::MutexGuard<'_, Stand> {
    stand.lock().unwrap_or_else(PoisonError::into_inner)
}

impl SharedStand {
    pub(super) fn told(&self) -> Value {
        of(&self.stand).told.clone().unwrap_or_else(|| json!({"state": "none"}))
    }

    /// Starts a run, unless one is under way.
    pub(super) fn start(&self, body: &[u8]) -> Value {
        let wish: RunRequest = match serde_json::from_slice(body) {
            Ok(wish) => wish,
            Err(error) => return failed(&format!("this is not a robot: {error}"), "send name, text and actuator_kpa"),
        };
        let mut stand = of(&self.stand);
        if stand.runs {
            return match stand.stop {
                false => failed("a run is under way", "stop it, or wait for its end"),
                true => failed("the run that was stopped still builds its mesh", "try again in a moment"),
            };
        }
        let told = json!({"state": "runs", "what": "building the mesh", "share": 0.0});
        *stand = Stand { told: Some(told.clone()), runs: true, stop: false };
        let shared = Arc::clone(&self.stand);
        let thread = std::thread::Builder::new().stack_size(STACK);
        let spawned = thread.spawn(move || {
            let made = std::panic::catch_unwind(|| run(&wish, &shared));
            let told = match made {
                Ok(Ok(run)) => shape(&run),
                Ok(Err(FemError::Interrupted { .. })) => json!({"state": "stopped"}),
                Ok(Err(error)) => failed(&error.to_string(), error.help().unwrap_or("change the robot and try again")),
                Err(_) => failed("the run broke off", "please report it with the scenario's text"),
            };
            *of(&shared) = Stand { told: Some(told), ..Stand::default() };
        });
        if let Err(cause) = spawned {
            *stand = Stand {
                told: Some(failed(&format!("no thread for it: {cause}"), "close other programs")),
                ..Stand::default()
            };
        }
        stand.told.clone().unwrap_or(told)
    }

    /// The answer comes at once; a mesh that is being built is thrown away when it is there.
    pub(super) fn stop(&self) -> Value {
        let mut stand = of(&self.stand);
        if stand.runs {
            (stand.stop, stand.told) = (true, Some(json!({"state": "stopped"})));
        }
        drop(stand);
        self.told()
    }
}

fn run(wish: &RunRequest, stand: &Mutex<Stand>) -> Result<FeRun, FemError> {
    let pressure = ("pressures_kpa".to_string(), format!("[{:?}]", wish.actuator_kpa));
    let coarse = SMALL_RUN.map(|(key, value)| (key.to_string(), value.to_string()));
    let source = RunSource::new(&wish.name, &wish.text).with(&[&coarse[..], &[pressure]].concat())?;
    simulate(&source, &RunSettings::default(), &mut |what, share| {
        let mut stand = of(stand);
        if stand.stop {
            return ControlFlow::Break(());
        }
        stand.told = Some(json!({"state": "runs", "what": what, "share": share}));
        ControlFlow::Continue(())
    })
}

fn failed(message: &str, help: &str) -> Value {
    json!({"state": "failed", "message": message, "help": help})
}

/// Where the sections of the robot are at its last hold \[m\], from the base.
fn shape(run: &FeRun) -> Value {
    let Some(last) = run.readings().last() else { return failed("this is not a robot", "give a scenario with [body]") };
    let Reading { stations_m, moved_m, .. } = last;
    let moved = stations_m.iter().zip(moved_m).map(|(s, moved)| [s + moved[0], moved[1]]);
    let line: Vec<[f64; 2]> = std::iter::once([0.0, 0.0]).chain(moved).collect();
    json!({
        "state": "done", "line_m": line, "angle_deg": last.tip_angle_rad.to_degrees(), "actuator_kpa": 1e-3 * last.actuator_pa,
        "elements": run.summary.elements, "cpu_s": run.cost.cpu_s, "missing_share": run.summary.residual_share,
        "notices": run.notices,
    })
}
