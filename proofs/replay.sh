#!/usr/bin/env bash
# Builds the proofs, looks at the axioms of every theorem, and replays cases in Coq:
#   proofs/replay.sh PROGRAM                   the cases of the list below, and files that were changed, which Coq has to reject
#   proofs/replay.sh PROGRAM CASE.toml ...     these
#   proofs/replay.sh PROGRAM --all             all of cases/; says how many were refused, and why
# Says that it skipped where there is no coqc. Each file must be accepted within a minute of computing, closed under the
# axioms of the classical reals only.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
if ! command -v coqc >/dev/null; then
  echo "skipped: no coqc (Debian: coq libcoq-coquelicot); no proof was built and no case replayed"
  exit 0
fi
program=${1:?the program secant}
shift
all= change=
if [ "${1-}" = --all ]; then
  all=yes
  mapfile -t given < <(cd "$here/.." && find cases -name '*.toml' | sort)
  set -- "${given[@]/#/$here/../}"
elif [ $# -eq 0 ]; then
  cases=$here/../cases
  set -- "$cases/thesis/half-tangent.toml" "$cases/two-parameter/quarter-quarter.toml" "$cases/classical/takagi.toml" \
    "$cases/two-parameter/corner-3-5.toml" "$cases/bspline/degree-3.toml" "$cases/classical/koch-4.toml" \
    "$cases/control/bezier-cusp.toml" "$cases/two-parameter/interior-periodic.toml" "$cases/classical/levy.toml" \
    "$cases/irrational/regular-sqrt-2.toml" "$cases/reversed/barycentric-smooth.toml" "$cases/contraction/quarter-turns.toml"
  change=yes
fi
! grep -rnE '\b(Admitted|admit|Axiom|Parameter|Conjecture|Abort)\b' "$here/theories" || { echo "something is not proved"; exit 1; }
make -s -C "$here"
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
coq() { (ulimit -t 60; coqc -w none -Q "$here/theories" Secant "$1"); }

# What Coq printed of $2 lists some axioms, all of them those of the classical reals.
classical() {
  local allowed='ClassicalDedekindReals.sig_not_dec ClassicalDedekindReals.sig_forall_dec FunctionalExtensionality.functional_extensionality_dep'
  grep -q '^Axioms:' <<<"$1" || { echo "$2: no list of axioms"; return 1; }
  for axiom in $(sed '1,/^Axioms:/d' <<<"$1" | grep -oE '^[A-Za-z][A-Za-z_.]*'); do
    grep -qw "$axiom" <<<"$allowed" || { echo "$2: the axiom $axiom is not one of the classical reals"; return 1; }
  done
}

# Every theorem and lemma of the development in one term, whose axioms are theirs; and the names that README.md gives.
proved=$(cd "$here/theories" && grep -oE "^ *(Theorem|Lemma|Corollary) [A-Za-z0-9_']+" -- *.v | sed -E 's/\.v: *[A-Za-z]+ /./')
named=$(sed -nE '/^\| *(formal name|theory.md) /,/^$/p' "$here/README.md" | grep -oE '`[a-z][A-Za-z0-9_]{3,}`' | tr -d '\140' | sort -u)
[ "$(wc -l <<<"$proved")" -ge 300 ] && [ "$(wc -l <<<"$named")" -ge 50 ] || { echo "theorems are missing"; exit 1; }
{
  echo "From Secant Require Import $(cd "$here/theories" && ls -- *.v | sed 's/\.v$//' | tr '\n' ' ')."
  for name in $named; do echo "Check @$name."; done
  echo "Definition all_theorems := ($(sed 's/^/@/' <<<"$proved" | paste -sd, )). Print Assumptions all_theorems."
} > "$work/everything.v"
said=$(coq "$work/everything.v") || { echo "a name of README.md is not one of the development"; exit 1; }
classical "$said" "the development"
echo "$(wc -l <<<"$proved") theorems and lemmas rest on the axioms of the classical reals"

# 0: replayed, 1: not accepted, 2: nothing was written.
replay() {
  local file=$work/replayed.v code=0 said
  "$program" certify -q --no-check "$1" --coq "$file" > /dev/null 2> "$work/why" || code=$?
  # 1 is the exit code of a refuted verdict.
  [ $code -le 1 ] || return 2
  said=$(coq "$file" 2> "$work/why") || { echo "not accepted: ${1#"$here/../"}"; return 1; }
  classical "$said" "$1" || return 1
  grep -E '^ +(Stated as well|Not stated):' "$file" >> "$work/whole"
  rm "$file"
  echo "replayed: ${1#"$here/../"}"
}
replayed=0 failed=0 refused=0
for case in "$@"; do
  code=0
  replay "$case" || code=$?
  if [ $code -eq 0 ]; then
    replayed=$((replayed + 1))
  elif [ $code -eq 2 ] && [ -n "$all" ]; then
    refused=$((refused + 1))
    { sed 's/│//g' "$work/why" | tr '\n' ' ' | tr -s ' ' | grep -oE 'proofs/ covers [^(]*' || echo "no verdict of a curve"; } >> "$work/reasons"
  else
    cat "$work/why"
    failed=$((failed + 1))
  fi
done
if [ -n "$all" ]; then
  sort "$work/whole" | uniq -c | sort -rn
  echo "refused:"
  sed -E 's/proofs\/ covers //; s/ at the branch.*//; s/ *$//' "$work/reasons" | sort | uniq -c | sort -rn
  echo "of $# cases $replayed replayed, $failed not accepted, $refused refused"
fi
# A file in which one text stands in the place of another is not accepted.
refuted() {
  local file=$work/changed.v code=0 text
  "$program" certify -q --no-check "$here/../cases/$1" --coq "$file" > /dev/null 2> "$work/why" || code=$?
  [ $code -le 1 ] && text=$(< "$file") && [[ $text == *"$2"* ]] || { echo "$1: there is no $2 to be changed"; return 1; }
  printf '%s\n' "${text/"$2"/"$3"}" > "$file"
  ! coq "$file" > /dev/null 2> "$work/why" || { echo "accepted: $1 with $3 in the place of $2"; return 1; }
  grep -q Error "$work/why" || { cat "$work/why"; return 1; }
}
if [ -n "$change" ]; then
  # Another matrix, another ray, a dropped joint, another root.
  refuted thesis/half-tangent.toml '[5#4; 1#2; 0]; [-1#4; 1#2; 5#4]' '[5#4; 1#4; 0]; [-1#4; 3#4; 5#4]'
  refuted thesis/half-tangent.toml '(qv [-1; 1; 0])' '(qv [1; -1; 0])'
  refuted two-parameter/quarter-quarter.toml 'exact joint_0_1|' 'exact left_end|'
  refuted irrational/regular-sqrt-2.toml 'radicand := 2;' 'radicand := 3;'
  echo "4 changed files were rejected"
fi
[ $failed -eq 0 ]
