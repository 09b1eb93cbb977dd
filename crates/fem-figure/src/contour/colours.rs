//! Colours of bands: light near zero, darker on both sides.
//!
//! Lightness falls evenly in Oklab (Ottosson 2020), in which equal distances look equal, so bands can be
//! distinguished in print without colour too. Hues run from cyan to violet below zero and from yellow to
//! red above.

/// Lightness of the neutral band and of the last one.
const LIGHT: f64 = 0.965;
const DARK: f64 = 0.28;
/// Hues in degrees next to zero and far from it.
const BELOW: (f64, f64) = (205.0, 300.0);
const ABOVE: (f64, f64) = (85.0, 25.0);
const CHROMA: f64 = 0.17;

/// Lightness of the neutral band and of the last one on a dark ground.
const NIGHT: (f64, f64) = (0.27, 0.93);

/// Returns `#rrggbb` at a position from −1 (lowest) over 0 (neutral) to 1.
pub(crate) fn band_colour(position: f64) -> String {
    colour(position, (LIGHT, DARK))
}

/// Returns the colour for a dark ground: dark near zero, lighter on both sides.
pub(crate) fn dark_band_colour(position: f64) -> String {
    colour(position, NIGHT)
}

fn colour(position: f64, (neutral, last): (f64, f64)) -> String {
    let t = position.abs().min(1.0);
    let (near, far) = if position < 0.0 { BELOW } else { ABOVE };
    // The lighter hues are those near cyan and yellow on either ground.
    let (near, far) = if neutral > last { (near, far) } else { (far, near) };
    let lightness = neutral + (last - neutral) * t;
    let hue = (near + (far - near) * t).to_radians();
    let mut chroma = CHROMA * (1.0 - (1.0 - t).powi(2)).sqrt();
    // Chroma is reduced until a screen can show the colour.
    let channels = loop {
        let channels = linear_rgb(lightness, chroma * hue.cos(), chroma * hue.sin());
        if chroma < 1e-3 || channels.iter().all(|c| (-1e-4..=1.0001).contains(c)) {
            break channels;
        }
        chroma *= 0.97;
    };
    let [r, g, b] = channels.map(byte);
    format!("#{r:02x}{g:02x}{b:02x}")
}

fn linear_rgb(lightness: f64, a: f64, b: f64) -> [f64; 3] {
    let l = (lightness + 0.396_337_777_4 * a + 0.215_803_757_3 * b).powi(3);
    let m = (lightness - 0.105_561_345_8 * a - 0.063_854_172_8 * b).powi(3);
    let s = (lightness - 0.089_484_177_5 * a - 1.291_485_548 * b).powi(3);
    [
        4.076_741_662_1 * l - 3.307_711_591_3 * m + 0.230_969_929_2 * s,
        -1.268_438_004_6 * l + 2.609_757_401_1 * m - 0.341_319_396_5 * s,
        -0.004_196_086_3 * l - 0.703_418_614_7 * m + 1.707_614_701 * s,
    ]
}

fn byte(linear: f64) -> u8 {
    let linear = linear.clamp(0.0, 1.0);
    let encoded =
        if linear <= 0.003_130_8 { 12.92 * linear } else { 1.055 * linear.powf(1.0 / 2.4) - 0.055 };
    (255.0 * encoded).round() as u8
}

#[cfg(test)]
mod tests {
    use super::*;

    fn lightness(position: f64) -> f64 {
        let colour = band_colour(position);
        let channel = |k: usize| u8::from_str_radix(&colour[k..k + 2], 16).unwrap() as f64 / 255.0;
        // Relative luminance; its cube root is close to perceived lightness.
        let linear =
            |c: f64| if c <= 0.04045 { c / 12.92 } else { ((c + 0.055) / 1.055).powf(2.4) };
        (0.2126 * linear(channel(1)) + 0.7152 * linear(channel(3)) + 0.0722 * linear(channel(5)))
            .cbrt()
    }

    #[test]
    fn bands_darken_evenly_away_from_zero() {
        for sign in [-1.0, 1.0] {
            let steps: Vec<f64> = (0..10)
                .map(|k| {
                    lightness(sign * k as f64 / 10.0) - lightness(sign * (k + 1) as f64 / 10.0)
                })
                .collect();
            // For strong hues luminance differs somewhat from Oklab's lightness.
            assert!(steps.iter().all(|step| (0.03..0.11).contains(step)), "{steps:?}");
        }
        assert_eq!(band_colour(-3.0), band_colour(-1.0));
    }
}
