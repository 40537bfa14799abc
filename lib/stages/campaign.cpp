#include "stages/campaign.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <numeric>
#include <optional>
#include <set>
#include <tuple>
#include <utility>

#include "base/error.h"
#include "base/hash.h"
#include "base/text.h"
#include "io/file/text_file.h"

namespace st {
namespace {

using nlohmann::json;

struct Column {
  const char* name;
  std::string CampaignRow::*field;
};

constexpr std::array kColumns = {Column{"model", &CampaignRow::model},
                                 Column{"name", &CampaignRow::name},
                                 Column{"verdict", &CampaignRow::verdict},
                                 Column{"reason", &CampaignRow::reason},
                                 Column{"code", &CampaignRow::code},
                                 Column{"triangles", &CampaignRow::triangles},
                                 Column{"lifting surfaces", &CampaignRow::surfaces},
                                 Column{"held", &CampaignRow::held},
                                 Column{"least quality", &CampaignRow::quality},
                                 Column{"seconds", &CampaignRow::seconds},
                                 Column{"message", &CampaignRow::message},
                                 Column{"key", &CampaignRow::key}};

const char* name_of(int code) {
  switch (static_cast<ExitCode>(code)) {
    case ExitCode::kUsage:
      return "usage";
    case ExitCode::kInput:
      return "input";
    case ExitCode::kGeometry:
      return "geometry";
    case ExitCode::kIncomplete:
      return "incomplete";
    case ExitCode::kOutput:
      return "output";
    case ExitCode::kMismatch:
      return "mismatch";
    case ExitCode::kMemory:
      return "memory";
    default:
      return code > 128 ? "signal" : "internal";
  }
}

json last_line(const std::string& said) {
  const std::size_t end = said.find_last_not_of('\n');
  if (end == std::string::npos) return nullptr;
  const std::size_t begin = said.rfind('\n', end);
  const json found = json::parse(said.substr(begin == std::string::npos ? 0 : begin + 1, end - begin), nullptr, false);
  return found.is_discarded() ? json() : found;
}

/// null where it is missing, or null itself
json at(const json& object, const char* path) {
  const json::json_pointer pointer(path);
  return object.contains(pointer) ? object[pointer] : json();
}

void add_mesh(const json& said, CampaignRow& row) {
  row.verdict = at(said, "/passes") == true ? "passes" : "fails";
  for (const json& name : at(said, "/failed")) row.reason += (row.reason.empty() ? "" : " ") + name.get<std::string>();
  if (const json n = at(said, "/triangles"); n.is_number()) row.triangles = std::to_string(n.get<std::int64_t>());
  if (const json q = at(said, "/stages/st-check/quality/min"); q.is_number())
    row.quality = fmt::format("{:.3f}", q.get<double>());
  const json surfaces = at(said, "/stages/st-check/lifting_surfaces");
  row.surfaces = std::to_string(surfaces.size());
  double held = 1;
  for (const json& s : surfaces)
    if (const json h = at(s, "/held"); h.is_number()) held = std::min(held, h.get<double>());
  if (!surfaces.empty()) row.held = fmt::format("{:.2f}", held);
}

std::string quoted(const std::string& text) {
  if (text.find_first_of(",\"\n\r") == std::string::npos) return text;
  std::string all = "\"";
  for (const char c : text) all += c == '"' ? "\"\"" : std::string(1, c);
  return all + "\"";
}

/// The next line of a table, from `at` on; nothing at the end, or where it is torn.
std::optional<std::vector<std::string>> next_line(const std::string& text, std::size_t& at) {
  std::vector<std::string> fields(1);
  for (bool is_quoted = false; at < text.size(); ++at) {
    const char c = text[at];
    if (c == '"' && is_quoted && at + 1 < text.size() && text[at + 1] == '"')
      fields.back() += text[at++];
    else if (c == '"')
      is_quoted = !is_quoted;
    else if (c == ',' && !is_quoted)
      fields.emplace_back();
    else if (c == '\n' && !is_quoted)
      return ++at, fields;
    else
      fields.back() += c;
  }
  return std::nullopt;
}

std::string escaped(const std::string& text) {
  std::string all;
  for (const char c : text) {
    if (c == '&')
      all += "&amp;";
    else if (c == '<')
      all += "&lt;";
    else if (c == '"')
      all += "&quot;";
    else
      all += c;
  }
  return all;
}

/// Errors before meshes that fail, before those that pass; then by what is held of the lengths, and by quality.
std::tuple<int, std::string, std::string, std::string> rank_of(const CampaignRow& row) {
  const int kind = row.verdict == "error" ? 0 : row.verdict == "fails" ? 1 : 2;
  return {kind, row.held.empty() ? "1.00" : row.held, row.quality, row.model};
}

constexpr const char* kHead = R"(<!doctype html>
<html lang="en"><meta charset="utf-8"><title>Campaign</title>
<style>
body { font: 15px sans-serif; margin: 2em; color: #222 }
table { border-collapse: collapse }
td, th { padding: .3em .8em; border-bottom: 1px solid #ddd; text-align: left; vertical-align: middle }
td.n { text-align: right }
.error { color: #b00 } .fails { color: #b60 } .passes { color: #070 }
img { width: 160px; height: 120px; background: #fff }
@media print { body { margin: 0 } }
</style>
)";

}  // namespace

CampaignRow campaign_row(const std::string& model, const std::string& name, int code, const std::string& said,
                         double seconds) {
  CampaignRow row;
  row.model = model;
  row.name = name;
  row.code = std::to_string(code);
  row.seconds = fmt::format("{:.1f}", seconds);
  const json found = last_line(said);
  if (found.is_object() && found.contains("stages")) {
    add_mesh(found, row);
    return row;
  }
  row.verdict = "error";
  row.message = found.is_object() ? found.value("error", "") : "";
  const std::size_t colon = row.message.find(": ");
  const std::string stage =
      row.message.starts_with("st-") && colon != std::string::npos ? row.message.substr(0, colon) : "st-run";
  row.reason = fmt::format("{}: {}", stage, name_of(code));
  return row;
}

std::string campaign_key(const std::string& settings, std::span<const std::string> files) {
  try {
    std::string all = std::string(ST_VERSION) + settings;
    for (const std::string& file : files) {
      const std::string content = read_text_file(file);
      all += hash_hex(content.data(), content.size());
    }
    return hash_hex(all.data(), all.size());
  } catch (const Error&) {
    return "";
  }
}

std::vector<std::string> campaign_names(std::span<const std::string> models, std::span<const CampaignRow> earlier) {
  std::set<std::string> taken, used;
  for (const CampaignRow& row : earlier) taken.insert(row.name);
  std::vector<std::string> names;
  for (const std::string& model : models) {
    const auto own = std::find_if(earlier.begin(), earlier.end(), [&](const CampaignRow& row) {
      return row.model == model && !used.contains(row.name);
    });
    const std::string stem = std::filesystem::path(model).stem().string();
    std::string name = own != earlier.end() ? own->name : stem;
    if (own == earlier.end())
      for (int n = 2; !taken.insert(name).second; ++n) name = fmt::format("{}_{}", stem, n);
    used.insert(name);
    names.push_back(name);
  }
  return names;
}

std::string campaign_table(std::span<const CampaignRow> rows) {
  const auto line = [](const auto& text_of) {
    std::string all;
    for (const Column& c : kColumns) {
      if (&c != &kColumns[0]) all += ',';
      all += quoted(text_of(c));
    }
    return all += '\n';
  };
  std::string text = line([](const Column& c) { return c.name; });
  for (const CampaignRow& row : rows) text += line([&](const Column& c) { return row.*c.field; });
  return text;
}

std::vector<CampaignRow> read_campaign_table(const std::string& text) {
  std::vector<CampaignRow> rows;
  std::size_t at = 0;
  const auto heading = next_line(text, at);
  const bool is_ours = heading && heading->size() == kColumns.size() &&
                       std::equal(kColumns.begin(), kColumns.end(), heading->begin(),
                                  [](const Column& c, const std::string& name) { return name == c.name; });
  if (!is_ours) return rows;
  while (const auto fields = next_line(text, at)) {
    if (fields->size() != kColumns.size()) continue;
    CampaignRow row;
    for (std::size_t i = 0; i < kColumns.size(); ++i) row.*kColumns[i].field = (*fields)[i];
    rows.push_back(std::move(row));
  }
  return rows;
}

std::string campaign_summary(std::span<const CampaignRow> rows) {
  std::map<std::string, std::map<std::string, int>> reasons;
  for (const CampaignRow& row : rows) ++reasons[row.verdict][row.reason];
  const auto part = [&](const std::string& verdict, const std::string& one, const std::string& more) {
    int n = 0;
    std::string why;
    for (const auto& [reason, count] : reasons[verdict]) {
      n += count;
      if (!reason.empty())
        why += fmt::format("{}{}{}", why.empty() ? "" : ", ", count > 1 ? fmt::format("{} ", count) : "", reason);
    }
    return n == 0 ? "" : counted(n, one, more) + (why.empty() ? "" : " (" + why + ")");
  };
  std::string text;
  for (const std::string& p :
       {part("passes", "passes", "pass"), part("fails", "fails", "fail"), part("error", "error", "errors")})
    if (!p.empty()) text += (text.empty() ? "" : ", ") + p;
  return text;
}

std::string campaign_page(std::span<const CampaignRow> rows, std::span<const std::string> pictures,
                          const std::string& folder) {
  std::vector<std::size_t> order(rows.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return rank_of(rows[a]) < rank_of(rows[b]); });
  std::string page = kHead + fmt::format(
                                 "<h1>{} models</h1>\n<p>{}</p>\n<table>\n<tr><th><th>model<th>verdict<th>why"
                                 "<th>triangles<th>lifting surfaces<th>held<th>least quality<th>seconds\n",
                                 rows.size(), escaped(campaign_summary(rows)));
  for (const std::size_t i : order) {
    const CampaignRow& r = rows[i];
    const std::string at = folder.empty() ? r.name : folder + "/" + r.name;
    const std::string target = at + (r.verdict == "error" ? "/log.txt" : "/report.html");
    const std::string picture = pictures[i].empty() ? "" : fmt::format("<img alt=\"\" src=\"{}\">", pictures[i]);
    page += fmt::format("<tr><td><a href=\"{0}\">{1}</a><td><a href=\"{0}\">{2}</a><td class=\"{3}\">{3}<td>{4}",
                        escaped(target), picture, escaped(r.name), r.verdict,
                        escaped(r.message.empty() ? r.reason : r.message));
    for (const std::string* value : {&r.triangles, &r.surfaces, &r.held, &r.quality, &r.seconds})
      page += fmt::format("<td class=\"n\">{}", escaped(*value));
    page += "\n";
  }
  return page + "</table>\n</html>\n";
}

}  // namespace st
