#include "base/similarity.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <sstream>
#include <vector>

#include "base/error.h"
#include "base/text.h"

namespace st {
namespace {

/// One step as it is written.
struct Step {
  std::string verb;
  std::vector<double> numbers;  ///< behind the verb
  std::optional<Vec3> at;       ///< behind the word "at"
  bool is_readable = true;      ///< nothing is left over
};

std::vector<double> read_numbers(std::istringstream& words) {
  std::vector<double> numbers;
  for (double x; words >> x;) numbers.push_back(x);
  words.clear();
  return numbers;
}

Step read_step(const std::string& text) {
  std::istringstream words(text);
  Step step;
  words >> step.verb;
  step.numbers = read_numbers(words);
  std::string rest;
  if (!(words >> rest)) return step;
  const std::vector<double> point = read_numbers(words);
  step.is_readable = rest == "at" && point.size() == 3 && !(words >> rest);
  if (step.is_readable) step.at = Vec3{point[0], point[1], point[2]};
  return step;
}

/// Whether its numbers can move a model to where it still has its shape.
bool is_in_range(const Step& step) {
  std::vector<double> all = step.numbers;
  if (step.at) all.insert(all.end(), {step.at->x, step.at->y, step.at->z});
  const bool is_tiny = step.verb == "scale" && !all.empty() && all[0] > 0 && all[0] < 1 / kLargestCoordinate;
  return !is_tiny && std::all_of(all.begin(), all.end(), [](double x) { return std::abs(x) <= kLargestCoordinate; });
}

/// The motion of a step; nullopt for one that is none.
std::optional<Similarity> motion_of(const Step& step) {
  const std::vector<double>& v = step.numbers;
  const auto vector_at = [&](std::size_t i) { return Vec3{v[i], v[i + 1], v[i + 2]}; };
  if (!step.is_readable) return std::nullopt;
  const auto placed = [&](const Similarity& motion) { return step.at ? motion.about(*step.at) : motion; };
  if (step.verb == "rotate" && v.size() == 4 && norm(vector_at(0)) > 0)
    return placed(rotation_about(vector_at(0), radians(v[3])));
  if (step.verb == "mirror" && v.size() == 3 && norm(vector_at(0)) > 0) return placed(reflection_at(vector_at(0)));
  if (step.verb == "scale" && v.size() == 1 && v[0] > 0) return placed({.scale = v[0]});
  if (step.at) return std::nullopt;
  if (step.verb == "translate" && v.size() == 3) return Similarity{.translation = vector_at(0)};
  if (step.verb == "hinge" && v.size() == 7 && norm(vector_at(3) - vector_at(0)) > 0)
    return rotation_about(vector_at(3) - vector_at(0), radians(v[6])).about(vector_at(0));
  return std::nullopt;
}

}  // namespace

Similarity Similarity::then(const Similarity& next) const {
  Similarity both;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3 r = next.rotation[i];
    both.rotation[i] = r.x * rotation[0] + r.y * rotation[1] + r.z * rotation[2];
  }
  both.scale = scale * next.scale;
  both.translation = next(translation);
  return both;
}

Similarity Similarity::about(Vec3 point) const {
  Similarity moved = *this;
  moved.translation = (*this)(-1.0 * point) + point;
  return moved;
}

Similarity Similarity::inverse() const {
  Similarity back;
  back.rotation = {Vec3{rotation[0].x, rotation[1].x, rotation[2].x}, Vec3{rotation[0].y, rotation[1].y, rotation[2].y},
                   Vec3{rotation[0].z, rotation[1].z, rotation[2].z}};
  back.scale = 1 / scale;
  back.translation = -back.scale * back.rotated(translation);
  return back;
}

Similarity rotation_about(Vec3 axis, double angle) {
  const Vec3 n = normalized(axis);
  const double c = std::cos(angle), s = std::sin(angle);
  Similarity r;
  const double n_[3] = {n.x, n.y, n.z};
  const Vec3 unit[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const Vec3 skew[3] = {{0, -n.z, n.y}, {n.z, 0, -n.x}, {-n.y, n.x, 0}};
  for (std::size_t i = 0; i < 3; ++i) r.rotation[i] = c * unit[i] + s * skew[i] + ((1 - c) * n_[i]) * n;
  return r;
}

Similarity reflection_at(Vec3 normal) {
  const Vec3 n = normalized(normal);
  const double n_[3] = {n.x, n.y, n.z};
  Similarity r;
  for (std::size_t i = 0; i < 3; ++i) r.rotation[i] = r.rotation[i] - (2 * n_[i]) * n;
  return r;
}

Similarity parse_similarity(const std::string& text, const std::string& option) {
  Similarity all;
  std::istringstream steps(text);
  for (std::string step; std::getline(steps, step, ';');) {
    if (trimmed(step).empty()) continue;
    const Step read = read_step(step);
    if (!is_in_range(read))
      throw Error(ExitCode::kUsage,
                  option + ": '" + trimmed(step) + "': numbers are at most 1e12, and scales at least 1e-12");
    const std::optional<Similarity> one = motion_of(read);
    if (!one)
      throw Error(ExitCode::kUsage,
                  option + ": '" + trimmed(step) +
                      "' is not a step; write 'rotate X Y Z DEGREES [at X Y Z]', 'hinge X Y Z X Y Z DEGREES', "
                      "'mirror X Y Z [at X Y Z]', 'scale F [at X Y Z]' or 'translate X Y Z', with ';' between steps");
    all = all.then(*one);
  }
  return all;
}

}  // namespace st
