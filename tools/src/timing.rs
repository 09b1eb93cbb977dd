//! Times: the kind of machine on which they were measured, and their median.

/// Returns a description such as "On x86_64 with AVX-512, one thread".
pub fn machine() -> String {
    #[cfg(target_arch = "x86_64")]
    let lanes = [
        (" with AVX-512", std::arch::is_x86_feature_detected!("avx512f")),
        (" with AVX2 and FMA", std::arch::is_x86_feature_detected!("avx2")),
    ];
    #[cfg(not(target_arch = "x86_64"))]
    let lanes: [(&str, bool); 0] = [];
    let lanes = lanes.into_iter().find_map(|(name, has)| has.then_some(name)).unwrap_or_default();
    format!("On {}{lanes}, one thread", std::env::consts::ARCH)
}

/// Returns the median.
pub fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values.get(values.len() / 2).copied().unwrap_or(f64::NAN)
}
