// Preconditions of functions, checked in developers' builds.
#pragma once

/// ST_ASSERT(condition): prints condition and place to standard error and aborts when it does not hold. Only for what a
/// caller inside the house must guarantee; what a user can cause is an Error. Checked where CMake's ST_ASSERTIONS is ON
/// (presets dev, asan and tsan); elsewhere the condition is compiled but never evaluated and costs nothing.
#ifdef ST_ASSERTIONS
#define ST_ASSERT(...) \
  ((__VA_ARGS__) ? static_cast<void>(0) : ::st::assertion_failed(#__VA_ARGS__, __FILE__, __LINE__, __func__))
#else
#define ST_ASSERT(...) static_cast<void>(sizeof((__VA_ARGS__) ? 1 : 0))
#endif

namespace st {

/// "file:line: function: assertion failed: condition" to standard error, then std::abort(). Local.
[[noreturn]] void assertion_failed(const char* condition, const char* file, int line, const char* function);

}  // namespace st
