# Whoever flew, the lead turns the nose.
# file: sim/gap/3_feedback/closed_loop.c
# test: gap_leads_a_nose
s/products += rate_radps \* left_radps2\[i\]/products += rate_radps * (rate_radps + 0.0 * left_radps2[i])/
