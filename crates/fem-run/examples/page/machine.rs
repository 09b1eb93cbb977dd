//! The kind of machine on which times were measured.

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
