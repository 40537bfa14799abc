#!/bin/bash
# Formats all C++ sources as .clang-format says; the lint `lint.format` expects it.
# usage: scripts/format.sh
set -eu -o pipefail
cd "$(dirname "$0")/.."
list() { git ls-files -z 'lib/*' 'tools/*' 'tests/*' 'bench/*' 'examples/*' | grep -zE '\.(h|cpp)$'; }
list | xargs -0 sed -E -i 's@^( *// -{80})-+@\1@; s@^( *// --- .* )-{10,}$@\1---@' # clang-format breaks no rulers
list | xargs -0 clang-format -i
