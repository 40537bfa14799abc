// A confined process has no network, starts nothing and writes in its folder alone. Each test does it to a child.
#include "base/confinement.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <functional>
#include <string>

namespace st {
namespace {

constexpr int kNotSupported = 100;  // by this kernel

/// errno of `action`, 0 when it worked, in a child that may write into `folder`.
int confined(const std::string& folder, bool Confinement::*needed, const std::function<bool()>& action) {
  const pid_t child = fork();
  if (child == 0) {
    if (!(confine_process(folder).*needed)) _exit(kNotSupported);
    errno = 0;
    _exit(action() ? 0 : errno);
  }
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

bool can_write(const std::string& path) { return open(path.c_str(), O_WRONLY | O_CREAT, 0600) >= 0; }

class ConfinedFiles : public testing::Test {
 protected:
  ConfinedFiles() {
    mkdtemp(folder_);
    mkdtemp(other_);
  }
  ~ConfinedFiles() override {
    unlink((folder_ + std::string("/x")).c_str());
    unlink((other_ + std::string("/x")).c_str());
    rmdir(folder_);
    rmdir(other_);
  }
  int confined_files(const std::function<bool()>& action) {
    return confined(folder_, &Confinement::has_files_read_only, action);
  }
  char folder_[32] = "/tmp/confined_XXXXXX", other_[32] = "/tmp/confined_XXXXXX";
};

TEST(Confinement, leaves_no_sockets_no_programs_and_no_signals_to_others) {
  const auto call = [](const std::function<bool()>& action) {
    return confined("", &Confinement::has_no_network, action);
  };
  const int first = call([] { return socket(AF_INET, SOCK_STREAM, 0) >= 0; });
  if (first == kNotSupported) GTEST_SKIP() << "no seccomp here";
  EXPECT_EQ(first, EPERM);
  EXPECT_EQ(call([] { return socket(AF_UNIX, SOCK_STREAM, 0) >= 0; }), EPERM);
  EXPECT_EQ(call([] {
              char name[] = "/bin/true", *arguments[] = {name, nullptr};
              return execv(name, arguments) == 0;
            }),
            EPERM);
  EXPECT_EQ(call([] { return kill(getppid(), 0) == 0; }), EPERM);
  EXPECT_EQ(call([] { return open("/proc/self/status", O_RDONLY) >= 0; }), 0);
}

TEST_F(ConfinedFiles, are_written_in_the_folder_alone) {
  const std::string mine = folder_ + std::string("/x"), other = other_ + std::string("/x");
  const int first = confined_files([&] { return can_write(other); });
  if (first == kNotSupported) GTEST_SKIP() << "no Landlock here";
  EXPECT_EQ(first, EACCES);
  EXPECT_NE(access(other.c_str(), F_OK), 0);
  EXPECT_EQ(confined_files([&] { return can_write(mine) && unlink(mine.c_str()) == 0; }), 0);
  EXPECT_EQ(confined_files([&] { return rmdir(other_) == 0; }), EACCES);
  EXPECT_EQ(confined_files([&] { return symlink("/", mine.c_str()) == 0; }), EACCES);
  EXPECT_EQ(confined("", &Confinement::has_files_read_only, [&] { return can_write(mine); }), EACCES);
}

}  // namespace
}  // namespace st
