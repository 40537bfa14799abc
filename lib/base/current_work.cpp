#include "base/current_work.h"

#include <utility>

namespace st {
namespace {

thread_local const char* t_kind = nullptr;
thread_local std::int64_t t_number = 0;

}  // namespace

CurrentWork::CurrentWork(const char* kind, std::int64_t number)
    : kind_before_(std::exchange(t_kind, kind)), number_before_(std::exchange(t_number, number)) {}

CurrentWork::~CurrentWork() {
  t_kind = kind_before_;
  t_number = number_before_;
}

bool describe_current_work(char* text, int size) {
  if (!t_kind) return false;
  int n = 0;
  for (const char* c = t_kind; *c && n < size - 1; ++c) text[n++] = *c;
  if (n < size - 1) text[n++] = ' ';
  char digits[20];
  int n_digits = 0;
  for (std::int64_t rest = t_number; n_digits == 0 || rest > 0; rest /= 10)
    digits[n_digits++] = static_cast<char>('0' + rest % 10);
  while (n_digits > 0 && n < size - 1) text[n++] = digits[--n_digits];
  text[n] = '\0';
  return true;
}

}  // namespace st
