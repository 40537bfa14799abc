#!/bin/bash
# Prints "; did you mean X?" for the word most like the first one (edit distance, any case); nothing when less than
# half is alike.
# usage: scripts/nearest_word.sh WORD CANDIDATE...
set -eu
awk '
function least(a, b, c) { if (b < a) a = b; return c < a ? c : a }
function distance(s, t,    i, j, d) {
  for (i = 0; i <= length(s); ++i) d[i, 0] = i
  for (j = 0; j <= length(t); ++j) d[0, j] = j
  for (i = 1; i <= length(s); ++i)
    for (j = 1; j <= length(t); ++j)
      d[i, j] = least(d[i - 1, j] + 1, d[i, j - 1] + 1, d[i - 1, j - 1] + (substr(s, i, 1) != substr(t, j, 1)))
  return d[length(s), length(t)]
}
BEGIN {
  nearest = length(ARGV[1])
  for (k = 2; k < ARGC; ++k) {
    d = distance(tolower(ARGV[1]), tolower(ARGV[k]))
    if (2 * d <= length(ARGV[k]) && d < nearest) { nearest = d; found = ARGV[k] }
  }
  if (found != "") printf "; did you mean %s?", found
}' "$@"
