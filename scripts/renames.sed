# Replaces the names in old results by the present names: sed -E -f scripts/renames.sed cells.jsonl
# Digests of scenarios and methods still differ. So do the intervals of a renamed method in summary.json, because the
# method's name is the key of its dice.
s/ccd-nullspace/gauss-newton/g
s/\bnullspace\b/gauss-newton/g
# Rename facts, series, digests and reasons of transitions.
s/(\\?")seam_frame(s?\\?":)/\1transition_frame\2/g
s/(\\?")switches(\\?": ?\[)/\1transition_points\2/g
s/"digest_switches":/"digest_transition":/g
s/(\\?")meeting(\\?":)/\1point\2/g
s/(\\?")fate(\\?":)/\1outcome\2/g
s/\bmeeting_partials\b/point_partials/g
s/\bcandidate_meeting\b/candidate_point/g
s/\bcandidate_fate\b/candidate_outcome/g
s/goes on: no switch, for comparison/goes on: no transition, for comparison/g
s/\ba switch needs two clips/a transition needs two clips/g
s/\ba switch is judged over at least/a transition is judged over at least/g
s/nothing moves around the seam, or too shortly/nothing moves around the transition, or too shortly/g
# Rename metrics of the coach's transitions.
s/\bswitch_(jump_cm|natural_share|bridged_share)\b/transition_\1/g
