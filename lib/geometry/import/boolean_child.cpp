#include "geometry/import/boolean_child.h"

#include <BinTools.hxx>
#include <Standard_Failure.hxx>
#include <TopoDS_Iterator.hxx>
#include <chrono>
#include <sstream>
#include <stdexcept>

#include "base/child_process.h"
#include "base/error.h"
#include "geometry/brep/compound.h"
#include "geometry/brep/shape_queries.h"

namespace st::occt {
namespace {

std::string bytes_of(const BooleanResult& result) {
  std::vector<TopoDS_Shape> all{compound_of(std::vector<TopoDS_Shape>{result.shape})};
  all.insert(all.end(), result.images.begin(), result.images.end());
  std::ostringstream stream;
  BinTools::Write(compound_of(all), stream);
  return stream.str();
}

BooleanResult result_of(const std::string& bytes) {
  std::istringstream stream(bytes);
  TopoDS_Shape all;
  BinTools::Read(all, stream);
  if (all.IsNull()) throw std::runtime_error("no result");
  BooleanResult result;
  for (TopoDS_Iterator child(all); child.More(); child.Next())
    if (result.shape.IsNull())
      result.shape = TopoDS_Iterator(child.Value()).Value();
    else
      result.images.push_back(child.Value());
  return result;
}

std::string bytes_of_work(const std::function<BooleanResult()>& work) {
  try {
    const BooleanResult result = work();
    if (result.shape.IsNull()) throw std::runtime_error("no result");
    return bytes_of(result);
  } catch (const Standard_Failure& e) {
    throw std::runtime_error(e.DynamicType()->Name());
  }
}

}  // namespace

BooleanAttempt run_boolean(const std::function<BooleanResult()>& work, double cpu_seconds) {
  const auto start = std::chrono::steady_clock::now();
  try {
    return {result_of(run_in_child([&] { return bytes_of_work(work); }, {cpu_seconds}, "boolean operation")), ""};
  } catch (const std::exception& e) {
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
    if (elapsed.count() >= cpu_seconds) return {{}, "OpenCASCADE needs more than " + format_number(cpu_seconds) + " s"};
    return {{}, e.what()};
  }
}

}  // namespace st::occt
