# curves.gp - the thrust ratio over the distance in metres, for gnuplot: seven weights (thesis 5.2), and the thesis's theory.
rbf(z,w1,w2,w3,w4,w5,w6,w7) = w1 + w2*exp(-15000*z**2) + w3*exp(-10000*(z-0.005)**2) + w4*exp(-5000*(z-0.015)**2) \
  + w5*exp(-2000*(z-0.03)**2) + w6*exp(-1250*(z-0.06)**2) + w7*exp(-1000*(z-0.1)**2)
theory(z) = 1 + 0.44*exp(-80*z)
