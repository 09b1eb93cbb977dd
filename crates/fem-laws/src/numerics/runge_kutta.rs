//! Differential equations by the Runge–Kutta method of order 8 of Dormand & Prince, in steps of a controlled error.
//!
//! Hairer, Nørsett & Wanner, *Solving Ordinary Differential Equations I*, section II.10: coefficients and control of the
//! program DOP853, whose error estimate combines those of orders 5 and 3. The rates do not depend on the clock.

/// Weights of the earlier stages in the state at which a stage is evaluated.
#[rustfmt::skip]
const STAGES: [&[f64]; 12] = [
    &[],
    &[0.052_600_151_958_767_73],
    &[0.019_725_056_984_537_9, 0.059_175_170_953_613_7],
    &[0.029_587_585_476_806_85, 0.0, 0.088_762_756_430_420_54],
    &[0.241_365_134_159_266_7, 0.0, -0.884_549_479_328_286_1, 0.924_834_003_261_792],
    &[0.037_037_037_037_037_035, 0.0, 0.0, 0.170_828_608_729_473_86, 0.125_467_687_566_822_42],
    &[0.037_109_375, 0.0, 0.0, 0.170_252_211_019_544_05, 0.060_216_538_980_455_96,
      -0.017_578_125],
    &[0.037_092_000_118_504_79, 0.0, 0.0, 0.170_383_925_712_239_98, 0.107_262_030_446_373_28,
      -0.015_319_437_748_624_402, 0.008_273_789_163_814_023],
    &[0.624_110_958_716_075_7, 0.0, 0.0, -3.360_892_629_446_941_4, -0.868_219_346_841_726,
      27.592_099_699_446_71, 20.154_067_550_477_894, -43.489_884_181_069_96],
    &[0.477_662_536_438_264_34, 0.0, 0.0, -2.488_114_619_971_667_7, -0.590_290_826_836_843,
      21.230_051_448_181_193, 15.279_233_632_882_423, -33.288_210_968_984_86,
      -0.020_331_201_708_508_627],
    &[-0.937_142_430_085_987_3, 0.0, 0.0, 5.186_372_428_844_064, 1.091_437_348_996_729_5,
      -8.149_787_010_746_927, -18.520_065_659_996_96, 22.739_487_099_350_505,
      2.493_605_552_679_652_3, -3.046_764_471_898_219_6],
    &[2.273_310_147_516_538, 0.0, 0.0, -10.534_495_466_737_25, -2.000_872_058_224_862_5,
      -17.958_931_863_118_8, 27.948_884_529_419_96, -2.858_998_277_135_023_5, -8.872_856_933_530_63,
      12.360_567_175_794_303, 0.643_392_746_015_763_6],
];
/// Weights of the stages in the mean rate over a step.
#[rustfmt::skip]
const RESULT: [f64; 12] = [
    0.054_293_734_116_568_765, 0.0, 0.0, 0.0, 0.0, 4.450_312_892_752_409, 1.891_517_899_314_500_3,
    -5.801_203_960_010_585, 0.311_164_366_957_819_9, -0.152_160_949_662_516_1,
    0.201_365_400_804_030_34, 0.044_710_615_727_772_59,
];
/// The same of order 3.
#[rustfmt::skip]
const THIRD_ORDER: [f64; 12] = [
    0.244_094_488_188_976_4, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.733_846_688_281_611_8, 0.0, 0.0,
    0.022_058_823_529_411_766,
];
/// The mean rate less that of order 5.
#[rustfmt::skip]
const FIFTH_ORDER: [f64; 12] = [
    0.013_120_044_994_194_88, 0.0, 0.0, 0.0, 0.0, -1.225_156_446_376_204_4,
    -0.495_758_949_657_250_2, 1.664_377_182_454_986_4, -0.350_328_848_749_973_66,
    0.334_179_118_713_017_5, 0.081_923_206_485_115_71, -0.022_355_307_863_886_294,
];

/// Bounds of the factor from one step to the next, and the share of the step that the error allows.
const FACTORS: (f64, f64) = (0.2, 10.0);
const SAFETY: f64 = 0.9;

/// Integrates N variables.
pub(crate) struct Integrator<const N: usize> {
    /// Relative tolerance of a step.
    pub tolerance: f64,
    /// Absolute tolerance of each variable.
    pub absolute: [f64; N],
    pub longest_step: f64,
    /// The step to try next.
    pub step: f64,
    /// Steps that may still be tried.
    pub n_left: usize,
}

impl<const N: usize> Integrator<N> {
    /// Returns the state after a step within the tolerance, and the step; `None` if no steps are left.
    pub fn advance(
        &mut self,
        from: &[f64; N],
        rates: impl Fn(&[f64; N]) -> [f64; N],
    ) -> Option<([f64; N], f64)> {
        let first = rates(from);
        let mut is_repeated = false;
        while self.n_left > 0 {
            self.n_left -= 1;
            let step = self.step;
            let (to, error) = self.try_step(from, first, step, &rates);
            let (least, most) = FACTORS;
            let most = if is_repeated && error <= 1.0 { 1.0 } else { most };
            // An error that is no number comes from a step far too long.
            let error = if error.is_nan() { f64::INFINITY } else { error };
            let factor = (SAFETY * error.powf(-0.125)).clamp(least, most);
            self.step = (step * factor).min(self.longest_step);
            if error <= 1.0 {
                return Some((to, step));
            }
            is_repeated = true;
        }
        None
    }

    /// Returns the state after a step, and its error over the tolerance.
    fn try_step(
        &self,
        from: &[f64; N],
        first: [f64; N],
        step: f64,
        rates: impl Fn(&[f64; N]) -> [f64; N],
    ) -> ([f64; N], f64) {
        let stages = stages(from, first, step, rates);
        let (to, mean) = result(from, step, &stages);
        let norm = |rate: [f64; N]| -> f64 {
            let scale =
                |i: usize| self.absolute[i] + self.tolerance * from[i].abs().max(to[i].abs());
            (0..N).map(|i| (rate[i] / scale(i)).powi(2)).sum()
        };
        let fifth = norm(weighted(&[0.0; N], 1.0, &FIFTH_ORDER, &stages));
        let both = fifth + 0.01 * norm(weighted(&mean, -1.0, &THIRD_ORDER, &stages));
        let both = if both <= 0.0 { 1.0 } else { both };
        (to, step * fifth * (both * N as f64).sqrt().recip())
    }
}

/// Returns the state after a step of any error.
pub(crate) fn after_step<const N: usize>(
    from: &[f64; N],
    step: f64,
    rates: impl Fn(&[f64; N]) -> [f64; N],
) -> [f64; N] {
    result(from, step, &stages(from, rates(from), step, rates)).0
}

/// Returns the state after a step with these stages, and the mean rate.
fn result<const N: usize>(
    from: &[f64; N],
    step: f64,
    stages: &[[f64; N]; 12],
) -> ([f64; N], [f64; N]) {
    let mean = weighted(&[0.0; N], 1.0, &RESULT, stages);
    (std::array::from_fn(|i| from[i] + step * mean[i]), mean)
}

/// Returns the rates in the stages of a step, the first of which is known.
fn stages<const N: usize>(
    from: &[f64; N],
    first: [f64; N],
    step: f64,
    rates: impl Fn(&[f64; N]) -> [f64; N],
) -> [[f64; N]; 12] {
    let mut stages = [first; 12];
    for (k, weights) in STAGES.iter().enumerate().skip(1) {
        stages[k] = rates(&weighted(from, step, weights, &stages));
    }
    stages
}

/// Returns a state plus the weighted sum of stages.
fn weighted<const N: usize>(
    from: &[f64; N],
    scale: f64,
    weights: &[f64],
    stages: &[[f64; N]; 12],
) -> [f64; N] {
    let mut sum = *from;
    for (weight, stage) in weights.iter().zip(stages) {
        for (own, rate) in sum.iter_mut().zip(stage) {
            *own += weight * scale * rate;
        }
    }
    sum
}
