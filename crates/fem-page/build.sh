#!/usr/bin/env bash
# The page, one file that needs no other and no network: target/page/index.html.
#
# Module and page are put together here: of web/page.html each line `<!-- inline: NAME -->` gives way to
# that file, the scripts of web/scripts without their imports and exports to one script, the module to
# its bytes, packed, as text. Needs Rust with rustup, gzip and base64.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
root=$(cd "$here/../.." && pwd)
cd "$root"

target=wasm32-unknown-unknown
if command -v rustup >/dev/null; then rustup target add --toolchain "$(rustup show active-toolchain | cut -d' ' -f1)" "$target" 2>/dev/null; fi
cargo rustc --package fem-page --lib --crate-type cdylib --profile page --target "$target" --locked
folder=${CARGO_TARGET_DIR:-target}
module=$folder/$target/page/fem_page.wasm

# Scripts in the order in which they stand on each other.
scripts=(units accounts materials scene links runner results picture controls stories telling taking page)

script() {
  local name
  for name in "${scripts[@]}"; do
    printf '// %s.js\n' "$name"
    sed -E '/^import .* from .*;$/d; s/^export //' "$here/web/scripts/$name.js"
  done
}

mkdir -p target/page
while IFS= read -r line; do
  case $line in
    '<!-- inline: style -->') printf '<style>\n'; cat "$here/web/style.css"; printf '</style>\n' ;;
    '<!-- inline: module -->') printf '<script type="text/plain" id="module">'
      gzip -9 -n -c "$module" | base64 -w 0
      printf '</script>\n' ;;
    '<!-- inline: worker -->') printf '<script type="text/plain" id="worker">\n'; cat "$here/web/worker.js"; printf '</script>\n' ;;
    '<!-- inline: boot -->') printf '<script>\n'; cat "$here/web/boot.js"; printf '</script>\n' ;;
    '<!-- inline: script -->') printf '<script type="module">\n'; script; printf '</script>\n' ;;
    *) printf '%s\n' "$line" ;;
  esac
done <"$here/web/page.html" >target/page/index.html

printf 'module %s bytes, packed %s; target/page/index.html %s bytes\n' \
  "$(stat -c %s "$module")" "$(gzip -9 -n -c "$module" | wc -c)" "$(stat -c %s target/page/index.html)"
