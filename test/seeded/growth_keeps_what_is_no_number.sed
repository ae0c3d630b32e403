# One flipped bit, and the growth of the thrust ratio is never seen again.
# file: src/judge_ceiling.c
# test: guard_forgets_a_growth
s/if (!(fabsf(s->n + s->f + s->ff + s->y + s->fy + s->yy) <= GROWTH_MOST))/if (false)/
