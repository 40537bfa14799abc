#include "base/confinement.h"

#include <fcntl.h>
#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/landlock.h>
#include <linux/seccomp.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstddef>
#include <cstdint>

namespace st {
namespace {

#if defined(__x86_64__)
constexpr std::uint32_t kArchitecture = AUDIT_ARCH_X86_64;
#elif defined(__aarch64__)
constexpr std::uint32_t kArchitecture = AUDIT_ARCH_AARCH64;
#else
constexpr std::uint32_t kArchitecture = 0;
#endif

constexpr std::array kForbidden = {__NR_socket,
                                   __NR_socketpair,
                                   __NR_connect,
                                   __NR_bind,
                                   __NR_listen,
                                   __NR_execve,
                                   __NR_execveat,
                                   __NR_ptrace,
                                   __NR_kill,
                                   __NR_bpf,
                                   __NR_perf_event_open,
                                   __NR_mount,
                                   __NR_process_vm_readv,
                                   __NR_process_vm_writev,
                                   __NR_pidfd_send_signal,
                                   __NR_unshare,
                                   __NR_setns,
                                   __NR_io_uring_setup,
                                   __NR_userfaultfd,
                                   __NR_keyctl};

/// Forbidden calls fail with EPERM.
bool forbid_calls() {
  constexpr std::size_t kBefore = 5, kAfter = 2;
  constexpr std::uint32_t kOtherNumbers = 0x40000000;  // of x32: the same calls by other numbers
  std::array<sock_filter, kBefore + kForbidden.size() + kAfter> program{};
  const auto n = static_cast<std::uint8_t>(kForbidden.size());
  std::size_t at = 0;
  program[at++] = BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(seccomp_data, arch));
  program[at++] = BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, kArchitecture, 1, 0);
  program[at++] = BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ERRNO | EPERM);  // calls of another architecture
  program[at++] = BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(seccomp_data, nr));
  program[at++] = BPF_JUMP(BPF_JMP | BPF_JGE | BPF_K, kOtherNumbers, static_cast<std::uint8_t>(n + 1), 0);
  for (std::uint8_t i = 0; i < n; ++i)
    program[at++] = BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, static_cast<std::uint32_t>(kForbidden[i]),
                             static_cast<std::uint8_t>(n - i), 0);
  program[at++] = BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW);
  program[at++] = BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ERRNO | EPERM);
  const sock_fprog filter{static_cast<unsigned short>(at), program.data()};
  return kArchitecture != 0 && prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &filter) == 0;
}

void allow_beneath(int rules, const char* folder, std::uint64_t access) {
  const int fd = open(folder, O_PATH | O_DIRECTORY | O_CLOEXEC);
  if (fd < 0) return;
  landlock_path_beneath_attr beneath{};
  beneath.allowed_access = access;
  beneath.parent_fd = fd;
  syscall(__NR_landlock_add_rule, rules, LANDLOCK_RULE_PATH_BENEATH, &beneath, 0);
  close(fd);
}

bool forbid_writing(const std::string& writable_folder) {
  constexpr std::uint64_t kFiles =
      LANDLOCK_ACCESS_FS_WRITE_FILE | LANDLOCK_ACCESS_FS_REMOVE_FILE | LANDLOCK_ACCESS_FS_MAKE_REG;
  landlock_ruleset_attr handled{};
  handled.handled_access_fs = kFiles | LANDLOCK_ACCESS_FS_EXECUTE | LANDLOCK_ACCESS_FS_REMOVE_DIR |
                              LANDLOCK_ACCESS_FS_MAKE_CHAR | LANDLOCK_ACCESS_FS_MAKE_DIR |
                              LANDLOCK_ACCESS_FS_MAKE_SOCK | LANDLOCK_ACCESS_FS_MAKE_FIFO |
                              LANDLOCK_ACCESS_FS_MAKE_BLOCK | LANDLOCK_ACCESS_FS_MAKE_SYM;
  const int rules = static_cast<int>(syscall(__NR_landlock_create_ruleset, &handled, sizeof handled, 0));
  if (rules < 0) return false;
  if (!writable_folder.empty()) allow_beneath(rules, writable_folder.c_str(), kFiles);
  allow_beneath(rules, "/dev", LANDLOCK_ACCESS_FS_WRITE_FILE);  // null, shm
  const bool is_done = syscall(__NR_landlock_restrict_self, rules, 0) == 0;
  close(rules);
  return is_done;
}

}  // namespace

Confinement confine_process(const std::string& writable_folder) noexcept {
  if (prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) != 0) return {};
  Confinement done;
  done.has_files_read_only = forbid_writing(writable_folder);
  done.has_no_network = forbid_calls();
  return done;
}

}  // namespace st
