// Fills the closed surface mesh mesh.msh with tetrahedra, for OpenFOAM's gmshToFoam.
Merge "mesh.msh";
Surface Loop(1) = Surface{:};
Volume(1) = {1};
Physical Volume("fluid") = {1};
Mesh.MshFileVersion = 2.2;
