//! Evaluates a claim: runs its study and makes its checks.

use crate::check::{Check, CheckResult};
use crate::claim::Claim;
use crate::error::StudyError;
use crate::findings::Findings;
use crate::laboratory::{Laboratory, Observer, Price, Shelf};
use crate::studies::find_study;

/// The result of a claim.
#[derive(Debug, Clone)]
pub struct ClaimResult {
    /// The claim that was tested.
    pub claim: Claim,
    /// The results of its checks, in the order of the claim; empty if the study failed.
    pub checks: Vec<CheckResult>,
    /// Measurements, tables and figures of the study.
    pub findings: Findings,
    /// The error of a study that failed.
    pub error: Option<StudyError>,
    /// Cost of the claim.
    pub price: Price,
}

impl ClaimResult {
    /// Whether all checks were made and passed.
    pub fn passed(&self) -> bool {
        self.error.is_none() && self.checks.iter().all(|check| check.passed)
    }
}

/// Runs a claim's study and makes its checks.
pub fn evaluate(claim: &Claim, shelf: &Shelf, observer: &dyn Observer) -> ClaimResult {
    let laboratory = Laboratory::new(claim, shelf, observer);
    let study = find_study(&claim.study).map_err(StudyError::Parameters);
    let outcome = study.and_then(|study| study(&laboratory));
    let price = laboratory.price();
    let claim = claim.clone();
    match outcome {
        Ok(findings) => {
            let measured = |quantity: &str| findings.quantities.get(quantity).copied();
            let judge = |check: &Check| check.judge(measured(&check.quantity));
            let checks = claim.checks.iter().map(judge).collect();
            ClaimResult { checks, claim, findings, error: None, price }
        }
        Err(error) => {
            let findings = Findings::default();
            ClaimResult { claim, checks: Vec::new(), findings, error: Some(error), price }
        }
    }
}
