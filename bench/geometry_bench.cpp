// Times of the geometry layer beside OpenCASCADE's in the same run: points and derivatives of surfaces and curves, at
// nearby and at random parameters, and projection from a near guess. A table of the ratios follows the times.
//   geometry_bench [--benchmark_filter=REGEX]     synthetic surfaces, and faces of the corpus when ST_CORPUS names its
//   folder
#include <benchmark/benchmark.h>
#include <fmt/format.h>
#include <BRep_Tool.hxx>
#include <BinTools.hxx>
#include <Extrema_GenLocateExtPS.hxx>
#include <Extrema_POnSurf.hxx>
#include <GeomAdaptor_Curve.hxx>
#include <GeomAdaptor_Surface.hxx>
#include <Geom_BSplineCurve.hxx>
#include <Geom_BSplineSurface.hxx>
#include <Geom_BezierSurface.hxx>
#include <Geom_RectangularTrimmedSurface.hxx>
#include <Geom_SurfaceOfLinearExtrusion.hxx>
#include <Geom_SurfaceOfRevolution.hxx>
#include <TColStd_Array1OfInteger.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <TColStd_Array2OfReal.hxx>
#include <TColgp_Array1OfPnt.hxx>
#include <TColgp_Array2OfPnt.hxx>
#include <TopExp.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Face.hxx>
#include <gp_Ax1.hxx>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <memory>
#include <numeric>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "geometry/brep/occt_evaluators.h"
#include "geometry/import/import.h"
#include "geometry/model/edit_model.h"
#include "geometry/model/model.h"

namespace {

using namespace st;

constexpr int kPoints = 4096;
constexpr double kStep = 1.0 / 2000;  // of the parameter range, between nearby points: about an edge length on a long
                                      // face
constexpr double kOffGuess = 1.0 / 500;  // of the parameter range, between a guess and its foot

/// Clamped uniform knots 0, 1/n ... 1 with multiplicities.
struct Knots {
  TColStd_Array1OfReal values;
  TColStd_Array1OfInteger multiplicities;
  Knots(int degree, int n_poles) : values(1, n_poles - degree + 1), multiplicities(1, n_poles - degree + 1) {
    const int n = n_poles - degree;
    for (int i = 0; i <= n; ++i) {
      values.SetValue(i + 1, double(i) / n);
      multiplicities.SetValue(i + 1, i == 0 || i == n ? degree + 1 : 1);
    }
  }
};

Handle(Geom_BSplineSurface) wavy_surface(int degree, int n_poles, bool is_rational) {
  TColgp_Array2OfPnt poles(1, n_poles, 1, n_poles);
  TColStd_Array2OfReal weights(1, n_poles, 1, n_poles);
  for (int i = 1; i <= n_poles; ++i)
    for (int j = 1; j <= n_poles; ++j) {
      const double x = 10.0 * (i - 1) / (n_poles - 1), y = 10.0 * (j - 1) / (n_poles - 1);
      poles.SetValue(i, j, gp_Pnt(x, y, std::sin(x) * std::cos(0.7 * y)));
      weights.SetValue(i, j, is_rational ? 1 + 0.3 * std::sin(x + y) : 1.0);
    }
  const Knots k(degree, n_poles);
  if (!is_rational)
    return new Geom_BSplineSurface(poles, k.values, k.values, k.multiplicities, k.multiplicities, degree, degree);
  return new Geom_BSplineSurface(poles, weights, k.values, k.values, k.multiplicities, k.multiplicities, degree,
                                 degree);
}

Handle(Geom_BSplineCurve) wavy_curve(int degree, int n_poles, bool is_rational) {
  TColgp_Array1OfPnt poles(1, n_poles);
  TColStd_Array1OfReal weights(1, n_poles);
  for (int i = 1; i <= n_poles; ++i) {
    const double x = 10.0 * (i - 1) / (n_poles - 1);
    poles.SetValue(i, gp_Pnt(x, 3 + 0.2 * std::cos(x), std::sin(x)));
    weights.SetValue(i, is_rational ? 1 + 0.3 * std::sin(x) : 1.0);
  }
  const Knots k(degree, n_poles);
  if (!is_rational) return new Geom_BSplineCurve(poles, k.values, k.multiplicities, degree);
  return new Geom_BSplineCurve(poles, weights, k.values, k.multiplicities, degree);
}

/// A walk that turns slowly and is reflected at the bounds, or points all over.
std::vector<Vec2> parameters(const Box2& b, bool is_nearby) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> uniform(0, 1);
  std::vector<Vec2> points(kPoints);
  Vec2 at{0.4, 0.5};
  double heading = 0.3;
  for (Vec2& p : points) {
    heading += 0.2 * (uniform(random) - 0.5);
    at = is_nearby ? at + kStep * Vec2{std::cos(heading), std::sin(heading)} : Vec2{uniform(random), uniform(random)};
    const Vec2 r{std::abs(std::remainder(at.x, 2.0)), std::abs(std::remainder(at.y, 2.0))};
    p = {b.lo.x + (b.hi.x - b.lo.x) * r.x, b.lo.y + (b.hi.y - b.lo.y) * r.y};
  }
  return points;
}

/// Times `work` per parameter; the name is case/operation/where/who.
template <class Parameter, class Work>
void add(const std::string& name, std::vector<Parameter> points, Work work) {
  benchmark::RegisterBenchmark(name.c_str(), [points = std::move(points), work](benchmark::State& state) {
    double sum = 0;
    for (auto _ : state) {
      for (const Parameter& p : points) sum += work(p);
      benchmark::DoNotOptimize(sum);
    }
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(points.size()));
  });
}

double sum(Vec3 a) { return a.x + a.y + a.z; }
template <class T>
double sum(const T& a) {
  return a.X() + a.Y() + a.Z();
}

/// evaluate_batch() over all parameters at once.
void add_batch(const std::string& name, std::shared_ptr<Surface> own, std::vector<Vec2> uv) {
  benchmark::RegisterBenchmark(name.c_str(), [own = std::move(own), uv = std::move(uv)](benchmark::State& state) {
    std::vector<SurfacePoint> out(uv.size());
    for (auto _ : state) {
      own->evaluate_batch(uv, out);
      benchmark::DoNotOptimize(out.data());
      benchmark::ClobberMemory();
    }
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(uv.size()));
  });
}

void add_surface(const std::string& name, const Handle(Geom_Surface) & geometry, const Box2& b) {
  const std::shared_ptr<Surface> own = occt::make_surface(geometry, b);
  const auto adaptor = std::make_shared<GeomAdaptor_Surface>(geometry);
  for (const bool is_nearby : {true, false}) {
    const std::vector<Vec2> uv = parameters(b, is_nearby);
    const std::string where = is_nearby ? "nearby" : "random";
    const auto id = [&](const char* what, const char* who) { return name + "/" + what + "/" + where + "/" + who; };
    add(id("d0", "own"), uv, [own](Vec2 p) { return sum(own->point(p)); });
    add(id("d0", "occt"), uv, [adaptor](Vec2 p) { return sum(adaptor->Value(p.x, p.y)); });
    add(id("d1", "own"), uv, [own](Vec2 p) {
      const SurfacePoint s = own->evaluate(p);
      return sum(s.x) + sum(s.du) + sum(s.dv);
    });
    const auto d1 = [](const auto& surface, Vec2 p) {
      gp_Pnt x;
      gp_Vec u, v;
      surface.D1(p.x, p.y, x, u, v);
      return sum(x) + sum(u) + sum(v);
    };
    add_batch(id("d1", "batch"), own, uv);
    add(id("d1", "occt"), uv, [adaptor, d1](Vec2 p) { return d1(*adaptor, p); });
    add(id("d1", "geom"), uv, [geometry, d1](Vec2 p) { return d1(*geometry, p); });
    add(id("d2", "own"), uv, [own](Vec2 p) {
      const SurfacePoint2 s = own->evaluate2(p);
      return sum(s.x) + sum(s.du) + sum(s.duu) + sum(s.duv) + sum(s.dvv);
    });
    add(id("d2", "occt"), uv, [adaptor](Vec2 p) {
      gp_Pnt x;
      gp_Vec u, v, uu, vv, w;
      adaptor->D2(p.x, p.y, x, u, v, uu, vv, w);
      return sum(x) + sum(u) + sum(uu) + sum(vv) + sum(w);
    });
  }
}

struct Target {
  Vec3 x;
  Vec2 guess;
};

/// Points slightly off the surface, in the order of a walk, with guesses beside their feet.
void add_projection(const std::string& name, const Handle(Geom_Surface) & geometry, const Box2& b) {
  const std::shared_ptr<Surface> own = occt::make_surface(geometry, b);
  const auto adaptor = std::make_shared<GeomAdaptor_Surface>(geometry);
  const double du = b.hi.x - b.lo.x, dv = b.hi.y - b.lo.y;
  std::vector<Target> targets;
  for (const Vec2 p : parameters(b, true)) {
    const SurfacePoint s = own->evaluate(p);
    const double off = 1e-4 * (norm(s.du) * du + norm(s.dv) * dv);
    targets.push_back({s.x + off * surface_normal(*own, p), {p.x + kOffGuess * du, p.y - kOffGuess * dv}});
  }
  add(name + "/project/nearby/own", targets, [own](const Target& t) {
    const auto uv = project_near(*own, t.x, t.guess);
    return uv ? uv->x + uv->y : 0.0;
  });
  const double size = 1e-12 * std::max(du, dv);
  const auto locate = std::make_shared<Extrema_GenLocateExtPS>(*adaptor, size, size);
  add(name + "/project/nearby/occt", targets, [locate, adaptor](const Target& t) {
    locate->Perform(gp_Pnt(t.x.x, t.x.y, t.x.z), t.guess.x, t.guess.y);
    double u = 0, v = 0;
    if (locate->IsDone()) locate->Point().Parameter(u, v);
    return u + v;
  });
}

void add_curve(const std::string& name, const Handle(Geom_Curve) & geometry) {
  const double t0 = geometry->FirstParameter(), t1 = geometry->LastParameter();
  const std::shared_ptr<Curve> own = occt::make_curve(geometry, t0, t1);
  const auto adaptor = std::make_shared<GeomAdaptor_Curve>(geometry);
  for (const bool is_nearby : {true, false}) {
    std::vector<double> t;
    for (const Vec2 p : parameters({{t0, 0}, {t1, 1}}, is_nearby)) t.push_back(p.x);
    const std::string id = name + "/d2/" + (is_nearby ? "nearby" : "random");
    add(id + "/own", t, [own](double s) {
      const CurvePoint p = own->evaluate(s);
      return sum(p.x) + sum(p.d1) + sum(p.d2);
    });
    add(id + "/occt", t, [adaptor](double s) {
      gp_Pnt x;
      gp_Vec d1, d2;
      adaptor->D2(s, x, d1, d2);
      return sum(x) + sum(d1) + sum(d2);
    });
  }
}

void add_synthetic() {
  for (const int degree : {3, 5})
    for (const bool is_rational : {false, true}) {
      const std::string name = fmt::format("nurbs{}{}", degree, is_rational ? "r" : "");
      add_surface(name, wavy_surface(degree, 30, is_rational), {{0, 0}, {1, 1}});
      add_projection(name, wavy_surface(degree, 30, is_rational), {{0, 0}, {1, 1}});
      add_curve("curve" + name.substr(5), wavy_curve(degree, 30, is_rational));
    }
  add_surface("nurbs3_large", wavy_surface(3, 100, false), {{0, 0}, {1, 1}});
  const gp_Ax1 axis(gp_Pnt(0, 0, 0), gp_Dir(1, 0, 0));
  add_surface("revolution", new Geom_SurfaceOfRevolution(wavy_curve(3, 30, false), axis), {{0, 0}, {2 * kPi, 1}});
  add_surface("extrusion", new Geom_SurfaceOfLinearExtrusion(wavy_curve(3, 30, false), gp_Dir(0, 1, 0.2)),
              {{0, 0}, {1, 10}});
}

/// One face of the model as a model of its own, face after face.
void add_extraction(const std::string& name, ModelTables tables, std::vector<std::byte> brep) {
  const auto model = std::make_shared<Model>(std::move(tables), std::move(brep));
  std::vector<FaceId> faces(static_cast<std::size_t>(model->tables().n_faces()));
  std::iota(faces.begin(), faces.end(), 0);
  add(name + "/extract/one face/own", faces,
      [model](FaceId f) { return double(extract(*model, std::span(&f, 1)).model.tables().n_edges()); });
}

/// The face with most poles of a corpus model.
void add_corpus_face(const std::filesystem::path& path) {
  const ImportResult r = import_model(path.string(), {});
  std::istringstream stream(std::string(reinterpret_cast<const char*>(r.brep.data()), r.brep.size()));
  TopoDS_Shape shape;
  BinTools::Read(shape, stream);
  TopTools_IndexedMapOfShape faces;
  TopExp::MapShapes(shape, TopAbs_FACE, faces);
  int best = 0, most_poles = 0;
  for (int f = 1; f <= faces.Extent(); ++f) {
    const auto s = Handle(Geom_BSplineSurface)::DownCast(BRep_Tool::Surface(TopoDS::Face(faces(f))));
    if (s.IsNull() || s->NbUPoles() * s->NbVPoles() <= most_poles) continue;
    best = f;
    most_poles = s->NbUPoles() * s->NbVPoles();
  }
  add_extraction(path.stem().string(), r.tables, r.brep);
  if (best == 0) return;
  const double* b = &r.tables.face_uv_bounds[4 * static_cast<std::size_t>(best - 1)];
  const Handle(Geom_Surface) s = BRep_Tool::Surface(TopoDS::Face(faces(best)));
  add_surface(path.stem().string(), s, {{b[0], b[2]}, {b[1], b[3]}});
  add_projection(path.stem().string(), s, {{b[0], b[2]}, {b[1], b[3]}});
}

/// Collects ns per point and prints own beside OpenCASCADE's at the end.
class RatioReporter : public benchmark::ConsoleReporter {
 public:
  void ReportRuns(const std::vector<Run>& runs) override {
    ConsoleReporter::ReportRuns(runs);
    for (const Run& run : runs) {
      const auto rate = run.counters.find("items_per_second");
      if (run.error_occurred || rate == run.counters.end()) continue;
      const std::string name = run.benchmark_name();
      const auto slash = name.rfind('/');
      double& ns = times_[name.substr(0, slash)][name.substr(slash + 1)];
      const double now = 1e9 / rate->second;
      ns = ns > 0 ? std::min(ns, now) : now;  // repetitions: the best
    }
  }
  void Finalize() override {
    GetOutputStream() << fmt::format("\n{:<44} {:>9} {:>9} {:>9} {:>9} {:>7}\n", "ns per point", "own", "batch",
                                     "adaptor", "Geom", "ratio");
    const auto ns = [](const std::map<std::string, double>& t, const char* who) {
      return t.contains(who) ? fmt::format("{:.1f}", t.at(who)) : "";
    };
    for (const auto& [name, t] : times_) {
      const std::string ratio =
          t.contains("own") && t.contains("occt") ? fmt::format("{:.1f}x", t.at("occt") / t.at("own")) : "";
      GetOutputStream() << fmt::format("{:<44} {:>9} {:>9} {:>9} {:>9} {:>7}\n", name, ns(t, "own"), ns(t, "batch"),
                                       ns(t, "occt"), ns(t, "geom"), ratio);
    }
  }

 private:
  std::map<std::string, std::map<std::string, double>> times_;
};

}  // namespace

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  add_synthetic();
  if (const char* corpus = std::getenv("ST_CORPUS"); corpus && *corpus)
    for (const char* name : {"aero_d150_wing_body_half.brep", "aero_onera_m6_sharpte.brep", "mech_occt_linkrods.step",
                             "mech_geouned_scdr.stp"})
      if (const auto path = std::filesystem::path(corpus) / name; std::filesystem::exists(path)) add_corpus_face(path);
  RatioReporter reporter;
  benchmark::RunSpecifiedBenchmarks(&reporter);
}
