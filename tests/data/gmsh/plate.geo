// The files here are what Gmsh 4.8.4 (Debian 12) writes of this one: for order 1 and 2, format 22 and 41, with -bin or without,
//     gmsh plate.geo -2 -order 1 -format msh22 -o plate-order1-msh22-text.msh
// and, with the nodes' parameters,
//     gmsh plate.geo -2 -order 2 -format msh41 -parametric -o plate-parametric.msh
// A 2 x 1 plate with a quarter of a hole; physical groups 11 (left), 12 (hole), 21 (plate).
SetFactory("Built-in");
h = 0.4;
Point(1) = {0.5, 0, 0, h}; Point(2) = {2, 0, 0, h}; Point(3) = {2, 1, 0, h}; Point(4) = {0, 1, 0, h};
Point(5) = {0, 0.5, 0, h}; Point(6) = {0, 0, 0, h};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 5}; Circle(5) = {5, 6, 1};
Curve Loop(1) = {1, 2, 3, 4, 5}; Plane Surface(1) = {1};
Physical Point("corner", 1) = {4};
Physical Curve("left", 11) = {4}; Physical Curve("hole", 12) = {5}; Physical Surface("plate", 21) = {1};
