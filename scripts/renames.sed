# Turns results of before a word was renamed into what they are now: sed -f scripts/renames.sed cells.jsonl
# Digests of scenarios and methods differ all the same, and so do the intervals of a renamed method in summary.json:
# their dice are keyed by its name.
s/ccd-nullspace/gauss-newton/g
s/\bnullspace\b/gauss-newton/g
