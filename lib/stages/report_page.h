// The page of st-report, without data: report_page.html, which the build makes part of the library.
#pragma once

#include <string_view>

namespace st {

/// HTML with places for data, each once: @META@ ... (report_stage.cpp).
std::string_view report_page();

}  // namespace st
