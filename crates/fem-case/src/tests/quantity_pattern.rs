//! Regular expressions of quantities as strings: for a length `22.2 mm`, but not `22.2 s`.
//!
//! A unit is one symbol, or a quotient of two or three in the usual form of the dimension: `m/s`, `kg/m^3`, `N/mm²`. An
//! expression cannot check the dimension of products, negative powers and parentheses, so any of known symbols are
//! accepted. There is no look-around, which some validators lack.

use crate::quantity::uncertain::SCALES;
use crate::quantity::unit_table::{PREFIXES, UNITS};

/// A number, with an ASCII or a Unicode minus sign.
const NUMBER: &str = r"\s*[-+−]?([0-9]+\.?[0-9]*|\.[0-9]+)([eE][-+]?[0-9]+)?";

const LENGTH: [i32; 4] = [1, 0, 0, 0];
const MASS: [i32; 4] = [0, 1, 0, 0];
const TIME: [i32; 4] = [0, 0, 1, 0];
const FORCE: [i32; 4] = [1, 1, -2, 0];
const ENERGY: [i32; 4] = [2, 1, -2, 0];
const VOLUME: [i32; 4] = [3, 0, 0, 0];

/// Returns the regular expression for strings of a dimension (metre, kilogram, second, byte).
pub(crate) fn pattern(dimension: [i32; 4]) -> String {
    let of = |dimension| symbols(|found| found == dimension);
    let (length, mass, time) = (of(LENGTH), of(MASS), of(TIME));
    let per = |above: &str, below: &str| format!(r"{above}\s*/\s*{below}");
    let (square, cube) = (power("2"), power("3"));
    let mut forms = vec![of(dimension)];
    match dimension {
        [0, 0, 0, 0] => forms.push(String::new()),
        [1, 0, -1, 0] => forms.push(per(&length, &time)),
        [1, 0, -2, 0] => {
            forms.push(per(&length, &format!("{time}{square}")));
            forms.push(per(&per(&length, &time), &time));
        }
        [-3, 1, 0, 0] => {
            forms.push(per(&mass, &format!("{length}{cube}")));
            forms.push(per(&mass, &of(VOLUME)));
        }
        [-1, 1, -2, 0] => forms.push(per(&of(FORCE), &format!("{length}{square}"))),
        [0, 1, -2, 0] => {
            forms.push(per(&of(FORCE), &length));
            forms.push(per(&of(ENERGY), &format!("{length}{square}")));
        }
        [0, 1, -1, 0] => forms.push(per(&mass, &time)),
        [0, 0, -1, 0] => forms.push(per("(1|rad|deg|°)?", &time)),
        _ => {}
    }
    forms.retain(|form| !form.is_empty() || dimension == [0; 4]);
    let unit = format!(r"(\s*({})|{})", forms.join("|"), entangled());
    // A unit that only one of value and uncertainty has is that of both.
    let uncertain = format!(r"{NUMBER}{unit}?\s*(±|\+/?-){NUMBER}({unit}|\s*%)?");
    format!(r"^({NUMBER}{unit}|{uncertain})\s*$")
}

/// Returns the regular expression for temperatures as strings.
pub(crate) fn temperature_pattern() -> String {
    let scale = format!(r"\s*({})", SCALES.map(|scale| scale.0).join("|"));
    format!(r"^{NUMBER}({scale}|({scale})?\s*(±|\+/?-){NUMBER}{scale})\s*$")
}

/// Returns the expression of a power after a symbol.
fn power(digit: &str) -> String {
    let raised = if digit == "2" { "²" } else { "³" };
    format!(r"((\^|\*\*)?{digit}|{raised})")
}

/// Returns the expression of units with a product, a negative power or parentheses, whose dimension is not checked.
fn entangled() -> String {
    let symbol = symbols(|_| true);
    let positive = format!(r"{symbol}((\^|\*\*)?[0-9]+|[²³])?");
    let negative = format!(r"{symbol}(\^|\*\*)?[-⁻−][0-9¹²³]+");
    let closed = r"(\s*\)((\^|\*\*)?[-⁻−]?[0-9¹²³]+)?)*";
    let any = format!(r"[\s(]*(1|{positive}|{negative}){closed}");
    // A 1 that is not a digit of the number has a blank before it.
    let first = format!(r"(\s*/?\s*{positive}|\s+1)");
    let product = format!(r"((\s*[*·⋅×]\s*|\s+){any}|\s*/?\s*{negative}|\s*/\s*\({any})");
    let bare = format!(r"\s*/?\s*({negative}|\({any})");
    format!(r"({first}(\s*/\s*{any})*{product}|{bare})(\s*[/*·⋅×]?\s*{any})*")
}

/// Returns a regular expression of all symbols whose dimension (metre, kilogram, second, byte) satisfies a condition; empty
/// if there are none.
fn symbols(is_one: impl Fn([i32; 4]) -> bool) -> String {
    let of = |prefixable: bool| {
        let units = UNITS.iter().filter(|unit| is_one(unit.scale.dimension));
        let symbols: Vec<_> =
            units.filter(|unit| unit.prefixable == prefixable).map(|unit| unit.symbol).collect();
        symbols.join("|")
    };
    let prefixes: Vec<_> = PREFIXES.iter().map(|(prefix, _)| *prefix).collect();
    let (plain, prefixable) = (of(false), of(true));
    let prefixed = format!("({})?({prefixable})", prefixes.join("|"));
    match (plain.is_empty(), prefixable.is_empty()) {
        (true, true) => String::new(),
        (false, true) => format!("({plain})"),
        (true, false) => format!("({prefixed})"),
        (false, false) => format!("({plain}|{prefixed})"),
    }
}
