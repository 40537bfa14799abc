#include "base/bounded_work.h"

#include <atomic>

namespace st {
namespace {

std::atomic<bool> g_is_abandoned{false};

}  // namespace

bool has_abandoned_work() { return g_is_abandoned; }
void note_abandoned_work() { g_is_abandoned = true; }

}  // namespace st
