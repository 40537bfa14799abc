// Limits of the process that live as long as a scope.
#pragma once

#include <sys/resource.h>

#include <algorithm>
#include <csignal>

namespace st {

/// `resource`: RLIMIT_NOFILE ...
class SoftLimit {
 public:
  SoftLimit(int resource, rlim_t most) : resource_(resource) {
    getrlimit(resource_, &before_);
    const rlimit now{std::min(most, before_.rlim_max), before_.rlim_max};
    setrlimit(resource_, &now);
  }
  ~SoftLimit() { setrlimit(resource_, &before_); }
  SoftLimit(const SoftLimit&) = delete;
  SoftLimit& operator=(const SoftLimit&) = delete;

 private:
  int resource_;
  rlimit before_{};
};

/// No file grows beyond so many bytes.
class FullDisk {
 public:
  explicit FullDisk(rlim_t most) : limit_(RLIMIT_FSIZE, most), before_(std::signal(SIGXFSZ, SIG_IGN)) {}
  ~FullDisk() { std::signal(SIGXFSZ, before_); }
  FullDisk(const FullDisk&) = delete;
  FullDisk& operator=(const FullDisk&) = delete;

 private:
  SoftLimit limit_;
  void (*before_)(int);
};

}  // namespace st
