#include "common/option_set.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/error.h"
#include "base/length.h"
#include "base/nearest_name.h"
#include "common/option_file.h"
#include "common/presets.h"

namespace st {
namespace {

/// The reading is left to CLI11; only the bounds are checked here, so that "not a number" has one message.
CLI::Validator in_interval(const NumberOption& option) {
  return CLI::Validator(
      [option](std::string& text) {
        double value = 0;
        return CLI::detail::lexical_cast(text, value) ? option.refusal(value) : "'" + text + "' is not a number";
      },
      option.interval);
}

/// 1e6 is a whole number, too: it is written out for options that take one.
CLI::Validator whole_written_out() {
  return CLI::Validator(
      [](std::string& text) {
        constexpr double kMostExact = 9e15;
        double value = 0;
        const bool is_whole = CLI::detail::lexical_cast(text, value) && value == std::floor(value);
        if (is_whole && std::abs(value) < kMostExact) text = std::to_string(static_cast<std::int64_t>(value));
        return std::string();
      },
      "");
}

CLI::Validator a_length(const std::string& flag) {
  return CLI::Validator(
      [flag](std::string& text) {
        try {
          parse_length(text, flag);
          return std::string();
        } catch (const Error& e) {
          return std::string(e.what()).substr(flag.size() + 2);  // the flag's name is put before by CLI11
        }
      },
      "");
}

}  // namespace

CLI::Validator a_name() {
  return CLI::Validator(
      [](std::string& text) { return text.empty() ? std::string("is an empty name; give a file") : std::string(); },
      "");
}

std::string said_by(const CLI::Error& e) {
  std::string text = e.what();
  for (char& c : text)
    if (c == '\n') c = ' ';
  while (!text.empty() && (text.back() == ' ' || text.back() == '.')) text.pop_back();
  if (const std::size_t at = text.find(": At Most 1 required"); at != std::string::npos)
    text.replace(at, std::string::npos, ": is given more than once; give it once");
  const std::string required = " is required";
  if (text.ends_with(required) && !text.starts_with('-'))
    text = "the input '" + text.substr(0, text.size() - required.size()) + "'" + required;
  const bool is_no_number = dynamic_cast<const CLI::ConversionError*>(&e);  // others have been refused before
  return is_no_number ? "a whole number is needed: " + text : text;
}

std::string usage_message(const CLI::Error& e, const std::string& tool) {
  return said_by(e) + "; see " + tool + " --help";
}

OptionSet::OptionSet(std::string name, const std::string& description)
    : name_(std::move(name)), app_(description, name_) {}

void OptionSet::input(const std::string& name, std::string& path, const std::string& help) {
  input_options_.push_back(app_.add_option(name, path, help)->required()->type_name("FILE")->check(a_name()));
}

void OptionSet::inputs(const std::string& name, std::vector<std::string>& paths, const std::string& help) {
  input_options_.push_back(app_.add_option(name, paths, help)->required()->type_name("FILE")->check(a_name()));
}

void OptionSet::input_arrays(const std::string& name, std::vector<std::string>& arrays, const std::string& help) {
  input_options_.push_back(app_.add_option(name, arrays, help)->required()->type_name(kArrayType)->check(a_name()));
}

void OptionSet::optional_input(const std::string& flag, std::string& path, const std::string& help) {
  input_options_.push_back(app_.add_option(flag, path, help)->type_name("FILE")->check(a_name()));
  file_options_.push_back(input_options_.back());
}

void OptionSet::optional_inputs(const std::string& flag, std::vector<std::string>& paths, const std::string& help) {
  input_options_.push_back(
      app_.add_option(flag, paths, help)->type_name("FILE")->allow_extra_args(false)->check(a_name()));
  file_options_.push_back(input_options_.back());
  repeated_flags_.push_back(flag);
}

void OptionSet::optional_array(const std::string& flag, std::string& value, const std::string& help) {
  input_options_.push_back(app_.add_option(flag, value, help)->type_name(kArrayType)->check(a_name()));
  file_options_.push_back(input_options_.back());
}

void OptionSet::output(std::string& path, const std::string& help) {
  CLI::Option* option = app_.add_option("-o,--output", path, help)->type_name("FILE");
  path.empty() ? option->required() : option->capture_default_str();
  output_options_.push_back(option);
}

void OptionSet::output_option(const std::string& flag, std::string& path, const std::string& help) {
  output_options_.push_back(
      app_.add_option(flag, path, help)->capture_default_str()->type_name("FILE")->check(a_name()));
}

void OptionSet::output_instead(const std::string& flag, std::string& path, const std::string& help) {
  output_option(flag, path, help);
  output_options_.back()->excludes(output_options_.front());
}

void OptionSet::outputs(const std::string& flag, std::vector<std::string>& paths, const std::string& help) {
  output_options_.push_back(
      app_.add_option(flag, paths, help)->type_name("FILE")->allow_extra_args(false)->check(a_name()));
}

void OptionSet::folder(const std::string& flag, std::string& path, const std::string& help) {
  app_.add_option(flag, path, help)->capture_default_str()->type_name("FOLDER")->check(a_name());
}

void OptionSet::length(const std::string& flag, std::string& value, const std::string& default_text,
                       const std::string& help) {
  file_options_.push_back(app_.add_option(flag, value, help)
                              ->type_name("LENGTH")
                              ->default_str(value.empty() ? default_text : value)
                              ->check(a_length(flag)));
}

void OptionSet::unit(const std::string& flag, std::string& value, const std::string& help) {
  const auto check = [](std::string& text) {
    return unit_in_metres(text) ? std::string() : "unknown unit '" + text + "'; write mm, cm, m, in or ft";
  };
  file_options_.push_back(app_.add_option(flag, value, help)->type_name("UNIT")->check(CLI::Validator(check, "")));
}

void OptionSet::text(const std::string& flag, std::string& value, const std::string& type, const std::string& help) {
  CLI::Option* option = app_.add_option(flag, value, help)->type_name(type);
  if (!value.empty()) option->capture_default_str();
  file_options_.push_back(option);
}

void OptionSet::texts(const std::string& flag, std::vector<std::string>& values, const std::string& type,
                      const std::string& help) {
  file_options_.push_back(app_.add_option(flag, values, help)->type_name(type)->allow_extra_args(false));
}

void OptionSet::add_number(const NumberOption& option, CLI::Option* bound) {
  file_options_.push_back(bound->type_name(option.unit)->check(in_interval(option))->transform(whole_written_out()));
}

void OptionSet::flag(const std::string& flag, bool& value, const std::string& help) {
  file_options_.push_back(app_.add_flag(flag, value, help)->disable_flag_override());
}

bool OptionSet::is_set(const std::string& flag) const { return app_.get_option(flag)->count() > 0; }

void OptionSet::preset() {
  text("--preset", preset_, "NAME",
       "settings for a purpose, which all other options override (docs/presets.md): " + preset_names());
}

std::vector<std::string> OptionSet::input_files() const {
  std::vector<std::string> files;
  for (const CLI::Option* option : input_options_)
    for (const std::string& value : option->results())
      files.push_back(option->get_type_name() == kArrayType ? value.substr(0, value.rfind(':')) : value);
  return files;
}

CLI::Option* OptionSet::find(const std::string& flag) { return app_.get_option_no_throw(flag); }

void OptionSet::set(const std::string& flag, const std::string& value) {
  CLI::Option* option = find(flag);
  option->add_result(value);
  try {
    option->run_callback();
  } catch (const CLI::Error& e) {
    throw Error(ExitCode::kUsage, usage_message(e, name_));
  }
}

void OptionSet::apply_file(const std::string& path, OptionFileTop top) { apply_option_file(path, name_, app_, top); }

void OptionSet::apply_preset() {
  if (!preset_.empty())
    apply_option_text(find_preset(preset_).options, "preset " + preset_, name_, app_, OptionFileTop::kHolds);
}

std::string OptionSet::settings_text() const { return option_file_settings(file_options_); }

}  // namespace st
