# Ripples around a drop: as a curve, or as a surface. Set before: width (of lines), kind, the output.
set terminal png size 320,240 linewidth width
set samples 200
set isosamples 40
r(x, y) = sqrt(x * x + y * y) + 1e-9
wave(x, y) = sin(r(x, y)) / r(x, y)
unset key
if (kind eq 'curve') plot [-20:20] wave(x, 0)
if (kind eq 'surface') unset ztics; set xtics 10; set ytics 10; set hidden3d; splot [-10:10] [-10:10] wave(x, y)
