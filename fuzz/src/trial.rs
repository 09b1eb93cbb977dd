//! Feeds many inputs to a target on several threads.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Mutex;
use std::sync::atomic::{AtomicU64, Ordering::Relaxed};
use std::thread;
use std::time::{Duration, Instant};

use crate::bounds::CurrentInput;
use crate::mutate::Random;

/// The result of a valid reader.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Taken {
    /// The input is valid.
    Accepted,
    /// The input is rejected with a message.
    Rejected,
}

/// A reader that is fuzzed. A panic is also a finding.
pub trait Target: Sync {
    /// Creates an input.
    fn make(&self, random: &mut Random) -> Vec<u8>;

    /// Reads an input.
    fn take(&self, input: &[u8]) -> Result<Taken, String>;
}

/// Checks the message of a rejected input.
pub fn rejected(message: &str) -> Result<Taken, String> {
    let is_tame = !message.contains(|c: char| c.is_control() && c != '\n');
    match is_tame && message.trim().len() > 8 && message.len() < 100_000 {
        true => Ok(Taken::Rejected),
        false => Err(format!("not a message for a user: {message:?}")),
    }
}

/// A fault of a reader.
#[derive(Clone, Debug)]
pub struct Finding {
    /// Number of the input.
    pub input: u64,
    /// Description of the fault.
    pub words: String,
}

/// Results of many inputs.
#[derive(Clone, Debug, Default)]
pub struct Counts {
    /// Number of valid inputs.
    pub accepted: u64,
    /// Number of inputs that were rejected with a message.
    pub rejected: u64,
    /// Faults of the reader.
    pub findings: Vec<Finding>,
    /// The slowest input and its duration.
    pub slowest: (u64, Duration),
}

/// Returns the bytes of an input.
pub fn input_of(target: &dyn Target, seed: u64, input: u64) -> Vec<u8> {
    target.make(&mut Random::of(seed, input))
}

/// Feeds the inputs with these numbers. An input that takes longer than `longest` ends the process.
pub fn try_inputs(
    target: &dyn Target,
    seed: u64,
    inputs: std::ops::Range<u64>,
    n_threads: usize,
    longest: Duration,
) -> Counts {
    let (began, next, left) =
        (Instant::now(), AtomicU64::new(inputs.start), AtomicU64::new(n_threads as u64));
    let current: Vec<CurrentInput> = (0..n_threads).map(|_| CurrentInput::default()).collect();
    let counts = Mutex::new(Counts::default());
    let work = |own_input: &CurrentInput| {
        let mut own = Counts::default();
        loop {
            let input = next.fetch_add(1, Relaxed);
            if input >= inputs.end {
                break;
            }
            own_input.begin(began, input);
            let bytes = input_of(target, seed, input);
            let taken = catch_unwind(AssertUnwindSafe(|| target.take(&bytes)));
            let took = own_input.end(began);
            own.add(input, taken.unwrap_or_else(|panic| Err(words_of(&*panic))), took);
        }
        left.fetch_sub(1, Relaxed);
        if let Ok(mut counts) = counts.lock() {
            counts.join(own);
        }
    };
    thread::scope(|scope| {
        for own_input in &current {
            scope.spawn(move || work(own_input));
        }
        while left.load(Relaxed) > 0 {
            thread::sleep(Duration::from_millis(20));
            if let Some(input) =
                current.iter().find_map(|own_input| own_input.overdue(began, longest))
            {
                eprintln!("input {input} takes more than {longest:?}");
                std::process::abort();
            }
        }
    });
    counts.into_inner().unwrap_or_default()
}

fn words_of(panic: &(dyn std::any::Any + Send)) -> String {
    let text = panic.downcast_ref::<String>().map(String::as_str);
    format!("panic: {}", text.or(panic.downcast_ref::<&str>().copied()).unwrap_or("without words"))
}

impl Counts {
    fn add(&mut self, input: u64, taken: Result<Taken, String>, took: Duration) {
        match taken {
            Ok(Taken::Accepted) => self.accepted += 1,
            Ok(Taken::Rejected) => self.rejected += 1,
            Err(words) => self.findings.push(Finding { input, words }),
        }
        if took > self.slowest.1 {
            self.slowest = (input, took);
        }
    }

    fn join(&mut self, other: Self) {
        self.accepted += other.accepted;
        self.rejected += other.rejected;
        self.findings.extend(other.findings);
        if other.slowest.1 > self.slowest.1 {
            self.slowest = other.slowest;
        }
    }
}
