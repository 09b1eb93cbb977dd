//! Mutations of texts and bytes, with random numbers that are the same on every machine.

use std::ops::Range;

use fastrand::Rng;

/// A generator of random numbers.
pub struct Random(Rng);

impl Random {
    /// Creates the generator of one input.
    pub fn of(seed: u64, input: u64) -> Self {
        Self(Rng::with_seed(seed.wrapping_mul(0x2545_f491_4f6c_dd1d) ^ input))
    }

    /// Returns 64 random bits.
    pub fn bits(&mut self) -> u64 {
        self.0.u64(..)
    }

    /// Returns a whole number below `n`, or 0 if `n` is 0.
    pub fn below(&mut self, n: usize) -> usize {
        if n == 0 { 0 } else { self.0.usize(..n) }
    }

    /// Returns one of the items.
    pub fn one_of<'a, T: ?Sized>(&mut self, all: &[&'a T]) -> &'a T {
        all[self.below(all.len())]
    }

    /// Returns true once in `n` calls on average.
    pub fn once_in(&mut self, n: usize) -> bool {
        self.below(n) == 0
    }

    /// Returns a range within a list of `n` items, usually a short one.
    pub fn stretch(&mut self, n: usize) -> Range<usize> {
        let start = self.below(n + 1);
        let longest = if self.once_in(4) { n } else { 8 };
        start..(start + self.below(longest + 1)).min(n)
    }
}

/// Numbers at the limits of formats and keys, separated by spaces.
const NUMBERS: &str = "0 -0.0 1 -1 2 3 0.5 0.4999999999 0.499999 -0.999 0.49 1e-3 1e3 1e-6 1e6 1e9 1e10 1e12 1e16 \
                       1e-9 1e-12 1e-30 1e30 1e75 1e-75 1e150 1e-150 1e300 -1e300 1e-300 5e-324 \
                       1.7976931348623157e308 nan inf -inf 9223372036854775807 -9223372036854775808 9007199254740993";

const UNITS: &str =
    "m mm um km kg/m^3 g/cm^3 GPa MPa Pa Pa*s N/m m/s cm/s m/s^2 s us 1/s % deg MB kg";

/// Syntax of TOML and XML, and characters with a special meaning for terminals or parsers.
const PIECES: &str = "[ ] { } = \" ' , # . [[ ]] \"\"\" \\ \u{0} \u{1b}[2J \u{feff} ± ° é \u{202e} _ + - e true false";
const SPACES: [&str; 3] = ["\n", "\r\n", "\t"];

/// Returns a number at a limit.
pub fn number(random: &mut Random) -> &'static str {
    word_of(NUMBERS, random)
}

/// Returns one of the words of a list.
fn word_of(list: &'static str, random: &mut Random) -> &'static str {
    list.split(' ').nth(random.below(list.split(' ').count())).unwrap_or("0")
}

/// Returns whether a byte belongs to a word: letters, digits and the other characters of numbers and keys.
fn is_of_word(byte: u8) -> bool {
    byte.is_ascii_alphanumeric() || b"_.+-".contains(&byte)
}

/// Returns the positions of the words of a text.
fn words(text: &[u8]) -> Vec<Range<usize>> {
    let mut words = Vec::new();
    let mut k = 0;
    while k < text.len() {
        let start = k;
        while k < text.len() && is_of_word(text[k]) {
            k += 1;
        }
        if k > start {
            words.push(start..k);
        }
        k += 1;
    }
    words
}

/// Mutates a text at a few places; some words come from `others`.
pub fn change_text(text: &mut Vec<u8>, others: &[Vec<u8>], random: &mut Random) {
    for _ in 0..=random.below(4) {
        match random.below(10) {
            0 => change_bytes(text, random),
            1 => change_lines(text, others, random),
            _ => change_word(text, others, random),
        }
    }
}

fn change_word(text: &mut Vec<u8>, others: &[Vec<u8>], random: &mut Random) {
    let words = words(text);
    if words.is_empty() {
        return;
    }
    let numeric: Vec<_> =
        words.iter().filter(|word| text[word.start].is_ascii_digit()).cloned().collect();
    let chosen = match numeric.is_empty() || random.once_in(3) {
        true => words[random.below(words.len())].clone(),
        false => numeric[random.below(numeric.len())].clone(),
    };
    let new: Vec<u8> = match random.below(8) {
        0 => word_of(UNITS, random).into(),
        1 if random.once_in(10) => random.one_of(&SPACES).into(),
        1 => word_of(PIECES, random).into(),
        2 => {
            let other = &others[random.below(others.len())];
            let theirs = self::words(other);
            theirs
                .get(random.below(theirs.len()))
                .map_or(vec![], |word| other[word.clone()].to_vec())
        }
        3 => {
            // The same number times a power of ten.
            let decades = random.below(41) as i32 - 20;
            [&text[chosen.clone()], format!("e{decades}").as_bytes()].concat()
        }
        4 => random.below(100).to_string().into_bytes(),
        _ => number(random).into(),
    };
    text.splice(chosen, new);
}

fn change_lines(text: &mut Vec<u8>, others: &[Vec<u8>], random: &mut Random) {
    let lines =
        |text: &[u8]| text.split_inclusive(|byte| *byte == b'\n').map(<[u8]>::to_vec).collect();
    let mut own: Vec<Vec<u8>> = lines(text);
    let theirs: Vec<Vec<u8>> = lines(&others[random.below(others.len())]);
    let at = random.stretch(own.len());
    match random.below(4) {
        0 => drop(own.drain(at)),
        1 => {
            let again = own[at.clone()].to_vec();
            own.splice(at.end..at.end, again);
        }
        2 => own[at].reverse(),
        _ => {
            let from = random.stretch(theirs.len());
            own.splice(at, theirs[from].iter().cloned());
        }
    }
    *text = own.concat();
}

/// Mutates some bytes.
pub fn change_bytes(bytes: &mut Vec<u8>, random: &mut Random) {
    let at = random.stretch(bytes.len());
    match random.below(7) {
        0 => drop(bytes.drain(at)),
        1 => {
            let again = bytes[at.clone()].to_vec();
            bytes.splice(at.end..at.end, again);
        }
        2 => bytes.truncate(at.start),
        3 => bytes[at].iter_mut().for_each(|byte| *byte = random.bits() as u8),
        4 => bytes[at]
            .iter_mut()
            .for_each(|byte| *byte = *[0, 0x7f, 0x80, 0xff].get(random.below(4)).unwrap_or(&0)),
        5 => {
            let new: Vec<u8> = (0..random.below(9)).map(|_| random.bits() as u8).collect();
            bytes.splice(at.start..at.start, new);
        }
        _ => {
            if let Some(byte) = bytes.get_mut(at.start) {
                *byte ^= 1 << random.below(8);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Many mutated texts are still TOML, most differ from the original, and they are reproducible.
    #[test]
    fn mutated_texts_differ_and_are_reproducible() {
        let others = [b"a = 1\nb = { c = 'x' }\n".to_vec(), b"[d]\ne = 2.5\n".to_vec()];
        let changed = |input| {
            let mut text = others[0].clone();
            change_text(&mut text, &others, &mut Random::of(1, input));
            text
        };
        let all: Vec<_> = (0..1000).map(changed).collect();
        assert_eq!(all, (0..1000).map(changed).collect::<Vec<_>>());
        let tomls =
            all.iter().filter(|text| String::from_utf8_lossy(text).parse::<toml::Table>().is_ok());
        assert!(tomls.count() > 300);
        assert!(all.iter().filter(|text| **text != others[0]).count() > 800);
    }
}
