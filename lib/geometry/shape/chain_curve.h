// Curves that go on into each other, as one.
#pragma once

#include <memory>
#include <vector>

#include "geometry/shape/composite_surface.h"
#include "geometry/shape/curve.h"

namespace st {

/// Where pieces of a chain stand on its parameter, which runs from 0: each over its length.
class ChainParameters {
 public:
  struct Piece {
    double from, to;  ///< own parameters at its begin and end in the chain; to < from where it is passed backwards
    double length;
  };
  explicit ChainParameters(std::vector<Piece> pieces);

  /// The piece that holds t; the first and the last one go on beyond the ends.
  std::size_t piece(double t) const;
  double own(std::size_t piece, double t) const;       ///< parameter of the piece
  double common(std::size_t piece, double own) const;  ///< and back
  double rate(std::size_t piece) const;                ///< derivative of own()
  double start(std::size_t piece) const { return start_[piece]; }
  double end() const { return start_.back(); }
  std::size_t size() const { return pieces_.size(); }

 private:
  std::vector<Piece> pieces_;
  std::vector<double> start_;  // [n_pieces+1]
};

/// Pieces head to tail; breaks are knots.
class ChainCurve final : public Curve {
 public:
  ChainCurve(ChainParameters parameters, std::vector<std::unique_ptr<Curve>> pieces);
  Vec3 point(double t) const override;
  CurvePoint evaluate(double t) const override;
  std::vector<double> knots() const override;
  std::optional<double> foot_near(Vec3 p, double guess) const override;
  std::unique_ptr<Curve> copy() const override;

 private:
  ChainParameters parameters_;
  std::vector<std::unique_ptr<Curve>> pieces_;
};

/// Likewise in a parameter plane.
class ChainCurve2d final : public Curve2d {
 public:
  ChainCurve2d(ChainParameters parameters, std::vector<std::unique_ptr<Curve2d>> pieces);
  Vec2 point(double t) const override;

 private:
  ChainParameters parameters_;
  std::vector<std::unique_ptr<Curve2d>> pieces_;
};

/// A trimming curve of a member, in the (u,v) of its composite: by the maps of the triangles along the rim.
class RimCurve2d final : public Curve2d {
 public:
  struct Segment {
    double t;       ///< where it begins
    MemberMap map;  ///< to (u,v) of the member
  };
  /// Precondition: segments ascend.
  RimCurve2d(std::unique_ptr<Curve2d> own, std::vector<Segment> segments);
  Vec2 point(double t) const override;

 private:
  std::unique_ptr<Curve2d> own_;
  std::vector<Segment> segments_;
};

}  // namespace st
