# curves.gp - the thrust ratio over the distance in metres: seven weights (thesis 5.2), and the thesis's theory.
# Of w, a text of seven numbers and seven more for each other curve, the n-th from 1 on.
weight(w, n, i) = real(word(w, 7*(n-1)+i))
rbf(z, w, n) = weight(w,n,1) + weight(w,n,2)*exp(-15000*z**2) + weight(w,n,3)*exp(-10000*(z-0.005)**2) \
  + weight(w,n,4)*exp(-5000*(z-0.015)**2) + weight(w,n,5)*exp(-2000*(z-0.03)**2) + weight(w,n,6)*exp(-1250*(z-0.06)**2) \
  + weight(w,n,7)*exp(-1000*(z-0.1)**2)
theory(z) = 1 + 0.44*exp(-80*z)
