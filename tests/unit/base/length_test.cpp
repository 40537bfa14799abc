#include "base/length.h"

#include <gtest/gtest.h>

#include <functional>
#include <string>

#include "base/error.h"

namespace st {
namespace {

ExitCode code_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const Error& e) {
    return e.code();
  }
  return ExitCode::kOk;
}

TEST(Length, plain_number_is_in_the_model_unit) {
  const LengthSpec spec = parse_length("3.5", "--lmin");
  EXPECT_EQ(spec.kind, LengthSpec::Kind::kModelUnit);
  EXPECT_EQ(resolve_length(spec, {100, 0.001}, "--lmin"), 3.5);
  EXPECT_EQ(resolve_length(spec, {100, std::nullopt}, "--lmin"), 3.5);
}

TEST(Length, per_cent_is_of_the_diagonal) {
  EXPECT_DOUBLE_EQ(resolve_length(parse_length("0.1%", "--lmin"), {250, 0.001}, "--lmin"), 0.25);
}

TEST(Length, of_chord_and_span_needs_a_lifting_surface) {
  const LengthSpec chord = parse_length("0.5%chord", "--edge-size"), span = parse_length("2 %span", "--edge-size");
  EXPECT_TRUE(chord.is_of_wing() && span.is_of_wing() && !parse_length("1%", "--edge-size").is_of_wing());
  EXPECT_DOUBLE_EQ(resolve_length(chord, {100, std::nullopt, 4, 30}, "--edge-size"), 0.02);
  EXPECT_DOUBLE_EQ(resolve_length(span, {100, std::nullopt, 4, 30}, "--edge-size"), 0.6);
  EXPECT_EQ(code_of([&] { resolve_length(chord, {100, 0.001}, "--edge-size"); }), ExitCode::kUsage);
}

TEST(Length, unit_is_converted_to_the_model_unit) {
  EXPECT_DOUBLE_EQ(resolve_length(parse_length("0.25mm", "--lmin"), {1, 1.0}, "--lmin"), 0.00025);
  EXPECT_DOUBLE_EQ(resolve_length(parse_length("2in", "--lmin"), {1, 0.001}, "--lmin"), 50.8);
  EXPECT_DOUBLE_EQ(resolve_length(parse_length(" 2 IN ", "--lmin"), {1, 0.0254}, "--lmin"), 2);
}

TEST(Length, unit_needs_a_model_with_a_unit_and_the_message_names_the_remedy) {
  try {
    resolve_length(parse_length("0.25mm", "--lmin"), {1, std::nullopt}, "--lmin");
    FAIL() << "a length with a unit was taken for a model without one";
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), ExitCode::kUsage);
    EXPECT_NE(std::string(e.what()).find("--unit"), std::string::npos);
    EXPECT_NE(std::string(e.what()).find("--lmin"), std::string::npos);
  }
}

TEST(Length, anything_else_is_a_usage_error_that_names_the_option) {
  for (const char* text :
       {"", " ", "x", "mm", "-1", "0", "0%", "1e999", "nan", "inf", "1,5", "3 4", "3pt", "1mm2", "%", "1%%"})
    EXPECT_EQ(code_of([&] { parse_length(text, "--lmax"); }), ExitCode::kUsage) << "'" << text << "'";
  try {
    parse_length("3pt", "--lmax");
  } catch (const Error& e) {
    EXPECT_EQ(std::string(e.what()).find("--lmax: '3pt'"), 0u);
  }
}

TEST(Length, beyond_what_single_precision_holds_is_refused_however_it_is_written) {
  for (const char* text : {"1e16", "1e300", "1e290%", "1e300km", "1e290%chord"})
    EXPECT_EQ(code_of([&] {
                resolve_length(parse_length(text, "--lmax"), {100, 0.001, 4}, "--lmax");
              }),
              ExitCode::kUsage)
        << text;
  EXPECT_EQ(resolve_length(parse_length("100%", "--lmax"), {3.4e12, 0.001}, "--lmax"), 3.4e12);
}

TEST(Length, unit_names_are_known_in_any_case_and_spelling) {
  EXPECT_EQ(unit_in_metres("mm"), 1e-3);
  EXPECT_EQ(unit_in_metres("MILLIMETRE"), 1e-3);
  EXPECT_EQ(unit_in_metres("Inch"), 0.0254);
  EXPECT_EQ(unit_in_metres("foot"), 0.3048);
  EXPECT_EQ(unit_in_metres("M"), 1.0);
  EXPECT_FALSE(unit_in_metres("parsec"));
  EXPECT_FALSE(unit_in_metres(""));
}

TEST(Length, a_number_is_followed_by_its_unit) {
  EXPECT_EQ(in_unit("mm"), " mm");
  EXPECT_EQ(in_unit("mm", 3), " mm^3");
  EXPECT_EQ(in_unit("", 2), "");
}

}  // namespace
}  // namespace st
