//! Feeds a target many inputs on several threads.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Mutex;
use std::sync::atomic::{AtomicU64, Ordering::Relaxed};
use std::thread;
use std::time::{Duration, Instant};

use crate::bounds::Post;
use crate::random::Random;
use crate::target::{Taken, Target};

/// An input that was taken as none may be.
#[derive(Clone, Debug)]
pub struct Finding {
    /// The input's number.
    pub input: u64,
    /// What happened.
    pub words: String,
}

/// What came of many inputs.
#[derive(Clone, Debug, Default)]
pub struct Counts {
    /// Inputs that were computed.
    pub accepted: u64,
    /// Inputs that were refused with a message.
    pub refused: u64,
    /// All others.
    pub findings: Vec<Finding>,
    /// The one that took longest, and how long.
    pub slowest: (u64, Duration),
}

/// The bytes of an input.
pub fn input_of(target: &dyn Target, seed: u64, input: u64) -> Vec<u8> {
    target.make(&mut Random::of(seed, input))
}

/// Feeds the inputs of these numbers. An input that takes longer than `longest` ends the process.
pub fn try_inputs(
    target: &dyn Target,
    seed: u64,
    inputs: std::ops::Range<u64>,
    n_threads: usize,
    longest: Duration,
) -> Counts {
    let (began, next, left) =
        (Instant::now(), AtomicU64::new(inputs.start), AtomicU64::new(n_threads as u64));
    let posts: Vec<Post> = (0..n_threads).map(|_| Post::default()).collect();
    let counts = Mutex::new(Counts::default());
    let work = |post: &Post| {
        let mut own = Counts::default();
        loop {
            let input = next.fetch_add(1, Relaxed);
            if input >= inputs.end {
                break;
            }
            post.begin(began, input);
            let bytes = input_of(target, seed, input);
            let taken = catch_unwind(AssertUnwindSafe(|| target.take(&bytes)));
            let took = post.end(began);
            own.add(input, taken.unwrap_or_else(|panic| Err(words_of(&*panic))), took);
        }
        left.fetch_sub(1, Relaxed);
        if let Ok(mut counts) = counts.lock() {
            counts.join(own);
        }
    };
    thread::scope(|scope| {
        for post in &posts {
            scope.spawn(move || work(post));
        }
        while left.load(Relaxed) > 0 {
            thread::sleep(Duration::from_millis(20));
            if let Some(input) = posts.iter().find_map(|post| post.overdue(began, longest)) {
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
            Ok(Taken::Refused) => self.refused += 1,
            Err(words) => self.findings.push(Finding { input, words }),
        }
        if took > self.slowest.1 {
            self.slowest = (input, took);
        }
    }

    fn join(&mut self, other: Self) {
        self.accepted += other.accepted;
        self.refused += other.refused;
        self.findings.extend(other.findings);
        if other.slowest.1 > self.slowest.1 {
            self.slowest = other.slowest;
        }
    }
}
