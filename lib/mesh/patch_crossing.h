// Triangles that cross each other, found cheaply where patches are smooth.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesh/crossing.h"

namespace st {

/// The patches of all CAD faces as one mesh, seen by face.
struct PatchTriangles {
  std::span<const Vec3> points;              ///< node coordinates, finite
  std::span<const Triangle> triangles;       ///< those of face 0, then of face 1, ...; patches share nodes by id
  std::span<const std::int32_t> face_begin;  ///< [n_faces+1] ascending from 0: face f has triangles [face_begin[f],
                                             ///< face_begin[f+1])
  std::span<const std::int32_t> face_body;   ///< [n_faces] faces of different bodies are not compared (kNone: one
                                             ///< common part)
  std::span<const char> face_is_dirty = {};  ///< [n_faces] pairs of triangles of clean faces are skipped; empty: all
                                             ///< faces are dirty
  std::span<const TriangleId> triangle_previous = {};  ///< [n_triangles] pairs of triangles that were there before (not
                                                       ///< kNone) are skipped; empty: all are new
};

/// The pairs of find_crossing_triangles, sorted by (a, b), that lie in faces of the same body, at least one of them
/// dirty, except what the cone rule below hides. Every pair listed is one exactly; pairs with one or two common nodes
/// are listed too.
///
/// Triangles of two faces are all compared where their boxes meet. Within a face, a part whose normals all lie within
/// 60 degrees of one direction is taken to be free of crossings: seen along that direction all of it faces the viewer,
/// so it can cross itself only where its contour crosses itself or where it winds around more than once (Volino and
/// Magnenat-Thalmann, Efficient self-collision detection on smoothly discretized surface animations using geometrical
/// shape regularity, 1994; Provot, Collision and self-collision handling in cloth model dedicated to design garments,
/// 1997). The contour is not looked at. Missed are thus crossings between triangles of one face with similar normals: a
/// sheet that laps over itself, turns of a thread or roll that lie in each other, some pairs around a fold (a folded
/// triangle itself is always found). Acceptable where meshes are made:
/// the loops of a face have been tested in its parameter plane, a folded triangle points the other way and opens the
/// cone, walls that cross for want of resolution face apart; and st-check makes the full test.
///
/// Linear in the triangles of smooth faces, as find_crossing_triangles elsewhere: trees are built only as deep as they
/// are descended. Where triangles lie in each other without end the search is ended (most_comparisons()): then
/// `was_ended` is set, and these are not all pairs.
std::vector<TrianglePair> find_crossing_patches(const PatchTriangles& mesh, bool& was_ended);
std::vector<TrianglePair> find_crossing_patches(const PatchTriangles& mesh);

/// Likewise the pairs of two faces alone: triangles [0, n_first) are of one, the others of the other.
std::vector<TrianglePair> find_crossings_between(std::span<const Vec3> points, std::span<const Triangle> triangles,
                                                 std::int32_t n_first, bool& was_ended,
                                                 std::int64_t* n_compared = nullptr);

}  // namespace st
