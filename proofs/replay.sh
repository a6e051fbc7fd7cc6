#!/usr/bin/env bash
# Builds the proofs and replays cases in Coq: proofs/replay.sh PROGRAM [CASE.toml ...]; without cases, the list below.
# Says that it skipped where there is no coqc. Each file must be accepted within a minute of computing, closed under the axioms of the
# classical reals only.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
if ! command -v coqc >/dev/null; then
  echo "skipped: no coqc (Debian: coq libcoq-coquelicot); no proof was built and no case replayed"
  exit 0
fi
program=${1:?the program secant}
shift
if [ $# -eq 0 ]; then
  cases=$here/../cases
  set -- "$cases/thesis/half-tangent.toml" "$cases/two-parameter/quarter-quarter.toml" "$cases/classical/takagi.toml" \
    "$cases/two-parameter/corner-3-5.toml" "$cases/bspline/degree-3.toml" "$cases/classical/koch-4.toml" \
    "$cases/control/bezier-cusp.toml" "$cases/two-parameter/interior-periodic.toml" "$cases/classical/levy.toml"
fi
! grep -rnE '\b(Admitted|admit|Axiom|Parameter|Conjecture|Abort)\b' "$here/theories" || { echo "something is not proved"; exit 1; }
make -s -C "$here"
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
allowed='ClassicalDedekindReals.sig_not_dec ClassicalDedekindReals.sig_forall_dec FunctionalExtensionality.functional_extensionality_dep'
for case in "$@"; do
  file=$work/replayed.v
  # 1 is the exit code of a refuted verdict.
  "$program" certify -q "$case" --coq "$file" || [ $? -eq 1 ]
  said=$(ulimit -t 60; coqc -w none -Q "$here/theories" Secant "$file") || { echo "$case: not accepted"; exit 1; }
  grep -q '^Axioms:' <<<"$said" || { echo "$case: no list of axioms"; exit 1; }
  for axiom in $(sed '1,/^Axioms:/d' <<<"$said" | grep -oE '^[A-Za-z][A-Za-z_.]*'); do
    grep -qw "$axiom" <<<"$allowed" || { echo "$case: the axiom $axiom is not one of the classical reals"; exit 1; }
  done
  rm "$file"
  echo "replayed: $case"
done
