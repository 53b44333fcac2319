//! Many runs on a cluster: the shards as one array job of Slurm or HyperQueue, watched until all parts are there.
//!
//! What runs on the cluster is the same command with `--shard K/N`. Its folder has to be seen by all machines.

use crate::SweepError;
use serde::{Deserialize, Serialize};
use std::ops::ControlFlow;
use std::path::PathBuf;
use std::process::Command;
use std::time::Duration;

/// Scheduler of a cluster, for which job scripts are written.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum Cluster {
    /// Slurm, with an array job: `sbatch`, `squeue`.
    Slurm,
    /// HyperQueue, with a task array of `hq`.
    HyperQueue,
}

/// Job of several shards of one command, as a scheduler takes it.
#[derive(Debug, Clone)]
pub struct Job {
    /// Path of the program that each shard calls.
    pub program: PathBuf,
    /// Its arguments other than threads and shard: a command and its options.
    pub words: Vec<String>,
    /// Folder that relative paths of the words count from.
    pub started_in: PathBuf,
    /// Folder of the job and its logs.
    pub folder: PathBuf,
    /// Number of shards, one task of the scheduler each.
    pub shards: usize,
    /// Number of threads that each shard asks for.
    pub threads: usize,
    /// The scheduler's own options, in one line; empty without.
    pub options: String,
}

const LOOK: Duration = Duration::from_millis(300);
/// Looks at the folder per question to the scheduler, whose answer takes a process and the time of its server.
const LOOKS_PER_QUESTION: usize = 10;
/// The job that was submitted, in the folder of the sweep.
const SUBMITTED: &str = "job.json";

#[derive(Serialize, Deserialize)]
struct Submitted {
    cluster: Cluster,
    id: String,
}

impl Cluster {
    fn variable(self) -> &'static str {
        match self {
            Cluster::Slurm => "SLURM_ARRAY_TASK_ID",
            Cluster::HyperQueue => "HQ_TASK_ID",
        }
    }

    fn is_alive(self, id: &str) -> bool {
        match self {
            Cluster::Slurm => asked("squeue", &["-h", "-j", id]).is_ok_and(|answer| !answer.trim().is_empty()),
            Cluster::HyperQueue => asked("hq", &["job", "info", id])
                .is_ok_and(|answer| ["WAITING", "RUNNING"].iter().any(|state| answer.contains(state))),
        }
    }
}

/// A word in quotes that a shell takes as it is.
fn quoted(word: &str) -> String {
    format!("'{}'", word.replace('\'', "'\\''"))
}

impl Job {
    /// The script of one shard, with what the scheduler reads in it.
    pub fn script(&self, cluster: Cluster) -> String {
        let Job { program, words, started_in, folder, shards, threads, options } = self;
        let logs = folder.join("logs");
        let (directive, head) = match cluster {
            Cluster::Slurm => {
                let output = format!("#SBATCH --output={}/%a.log\n", logs.display());
                let job = "#SBATCH --job-name=ibr-sweep\n";
                ("#SBATCH", format!("{job}#SBATCH --array=1-{shards}\n#SBATCH --cpus-per-task={threads}\n{output}"))
            }
            Cluster::HyperQueue => {
                let logs = logs.display();
                let output = format!("#HQ --stdout {logs}/%{{TASK_ID}}.log --stderr {logs}/%{{TASK_ID}}.err\n");
                ("#HQ", format!("#HQ --name ibr-sweep --array 1-{shards} --cpus {threads}\n{output}"))
            }
        };
        let own = if options.is_empty() { String::new() } else { format!("{directive} {options}\n") };
        let place = quoted(&started_in.display().to_string());
        let typed: Vec<String> =
            std::iter::once(&program.display().to_string()).chain(words).map(|word| quoted(word)).collect();
        format!(
            "#!/bin/bash\n{head}{own}cd {place}\nexec {} --quiet --threads {threads} --shard \"${}/{shards}\"\n",
            typed.join(" "),
            cluster.variable()
        )
    }

    /// Submits the job, or finds the one that an earlier call submitted, and waits until it has ended. `watch` receives the number
    /// of missing parts and answers whether to go on; the job itself runs on without the watcher. Submits again while that helps, and
    /// returns how many parts are missing then.
    ///
    /// # Errors
    /// No such scheduler, what it answered; [`SweepError::Run`] on an interrupt.
    pub fn run(
        &self,
        cluster: Cluster,
        missing: &dyn Fn() -> usize,
        watch: &mut dyn FnMut(usize) -> ControlFlow<()>,
    ) -> Result<usize, SweepError> {
        let mut before = usize::MAX;
        loop {
            let left = missing();
            let id = match self.submitted(cluster) {
                _ if left == 0 => return Ok(0),
                Some(id) => id,
                None if left >= before => return Ok(left),
                None => self.submit(cluster)?,
            };
            before = left;
            for look in 0.. {
                let left = missing();
                if (left == 0 || look % LOOKS_PER_QUESTION == 0) && !cluster.is_alive(&id) {
                    break;
                }
                if watch(left).is_break() {
                    return Err(fem::FemError::interrupted(0, self.shards).into());
                }
                std::thread::sleep(LOOK);
            }
            let _ = std::fs::remove_file(self.folder.join(SUBMITTED));
        }
    }

    /// A job of an earlier call that is still alive.
    fn submitted(&self, cluster: Cluster) -> Option<String> {
        let text = std::fs::read(self.folder.join(SUBMITTED)).ok()?;
        let Submitted { cluster: own, id } = serde_json::from_slice(&text).ok()?;
        (own == cluster && cluster.is_alive(&id)).then_some(id)
    }

    fn submit(&self, cluster: Cluster) -> Result<String, SweepError> {
        let logs = self.folder.join("logs");
        let unmade = |cause: std::io::Error| SweepError::Write { path: logs.clone(), cause: cause.to_string() };
        std::fs::create_dir_all(&logs).map_err(unmade)?;
        let script = self.folder.join("job.sh");
        std::fs::write(&script, self.script(cluster)).map_err(unmade)?;
        let script = script.display().to_string();
        let answer = match cluster {
            Cluster::Slurm => asked("sbatch", &["--parsable", &script]),
            // It reads the directives in the script, and starts it with the program of its first line.
            Cluster::HyperQueue => asked("hq", &["submit", "--directives", "file", "--output-mode", "quiet", &script]),
        }?;
        // With several clusters Slurm adds the name of one.
        let id = answer.trim().split([';', '\n']).next().unwrap_or_default().to_string();
        let job = serde_json::to_vec(&Submitted { cluster, id: id.clone() }).unwrap_or_default();
        std::fs::write(self.folder.join(SUBMITTED), job).map_err(unmade)?;
        Ok(id)
    }

    /// A job that ended without all parts.
    pub fn useless(&self) -> SweepError {
        SweepError::Cluster {
            message: "the job ended and no further part is there".into(),
            help: format!("read the logs in {}", self.folder.join("logs").display()),
        }
    }
}

fn asked(program: &str, words: &[&str]) -> Result<String, SweepError> {
    let help = "install it and start it, or make the shards by hand: --shard K/N; --script prints the job".to_string();
    let wrong = |message: String| SweepError::Cluster { message, help: help.clone() };
    let made = Command::new(program).args(words).output();
    let made = made.map_err(|cause| wrong(format!("`{program}` cannot be started: {cause}")))?;
    match made.status.success() {
        true => Ok(String::from_utf8_lossy(&made.stdout).into_owned()),
        false => Err(wrong(format!("`{program}`: {}", String::from_utf8_lossy(&made.stderr).trim()))),
    }
}
