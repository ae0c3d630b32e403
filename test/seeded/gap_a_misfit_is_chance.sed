# What a right form leaves is bounded by what nominal flights scatter.
# file: sim/gap/5_infer/unknown.c
# test: gap_measures_a_misfit_by_itself
s/hypot(chance, SELECT_LEAST \/ CANDIDATES_MISFIT \* share)/hypot(chance, chance * share)/
