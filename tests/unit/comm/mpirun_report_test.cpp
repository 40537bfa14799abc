// MpirunReport: what mpirun says of a rank that a signal ended, and what users see of its stderr.
#include "comm/mpirun_report.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <csignal>
#include <sstream>

namespace st {
namespace {

const std::string kRule(74, '-');

/// What is passed on of a text, line by line.
std::string filtered(MpirunReport& report, const std::string& text) {
  std::istringstream lines(text);
  std::string shown;
  for (std::string line; std::getline(lines, line);) shown += report.add(line + "\n");
  return shown + report.rest();
}

std::string banner(const std::string& text) { return kRule + "\n" + text + "\n" + kRule + "\n"; }

TEST(MpirunReport, names_rank_host_and_signal) {
  for (const std::string launcher : {"mpirun", "prterun"}) {
    MpirunReport report;
    const std::string shown = filtered(
        report,
        banner("Primary job  terminated normally, but 1 process returned\na non-zero exit code.") +
            banner(launcher + " noticed that process rank 12 with PID 0 on node n-7.b exited on signal 9 (Killed)."));
    ASSERT_TRUE(report.lost_rank());
    EXPECT_EQ(report.lost_rank()->rank, 12);
    EXPECT_EQ(report.lost_rank()->host, "n-7.b");
    EXPECT_EQ(report.lost_rank()->signal, 9);
    EXPECT_EQ(shown, "");
  }
}

TEST(MpirunReport, names_a_rank_that_ended_itself_on_a_signal) {
  MpirunReport report;
  filtered(report, banner("mpirun detected that one or more processes exited with non-zero status, thus causing\nthe "
                          "job to be terminated. "
                          "The first process to do so was:\n\n  Process name: [[36021,1],2]\n  Exit code:    143"));
  ASSERT_TRUE(report.lost_rank());
  EXPECT_EQ(report.lost_rank()->rank, 2);
  EXPECT_EQ(report.lost_rank()->signal, 15);
}

TEST(MpirunReport, tells_of_a_rank_that_mpirun_does_not_name_by_its_exit_code) {
  MpirunReport killed, failed, named;
  killed.add_exit_code(128 + SIGKILL);
  ASSERT_TRUE(killed.lost_rank());
  EXPECT_EQ(describe_lost_rank(*killed.lost_rank()).find("a rank was ended by signal 9 (Killed); out of memory?"), 0u);
  for (const int code : {0, 5, 70, 128, 213, 255}) failed.add_exit_code(code);
  EXPECT_FALSE(failed.lost_rank());
  named.add("mpirun noticed that process rank 1 with PID 7 on node n exited on signal 11 (x).\n");
  named.add_exit_code(128 + SIGKILL);
  ASSERT_TRUE(named.lost_rank());
  EXPECT_EQ(named.lost_rank()->rank, 1) << "what mpirun says comes first";
}

TEST(MpirunReport, takes_an_exit_code_for_no_signal) {
  MpirunReport report;
  EXPECT_EQ(
      filtered(report, banner("mpirun detected that one or more\n  Process name: [[36021,1],2]\n  Exit code:    5")),
      "");
  EXPECT_FALSE(report.lost_rank());
}

TEST(MpirunReport, drops_what_several_aborting_ranks_repeat) {
  MpirunReport report;
  EXPECT_EQ(filtered(report,
                     "[vm:17] 2 more processes have sent help message help-mpi-api.txt / mpi-abort\n"
                     "[vm:17] Set MCA parameter \"orte_base_help_aggregate\" to 0 to see all help / error messages\n"
                     "[vm:17] [[21004,0],0] ORTE_ERROR_LOG: Data unpack had inadequate space in file "
                     "orte/util/show_help.c at line 513\n"),
            "");
}

TEST(MpirunReport, drops_what_mpirun_says_when_a_terminal_stops_it) {
  MpirunReport report;
  EXPECT_EQ(filtered(report, "mpirun: Forwarding signal 20 to job\nmpirun: Forwarding signal 18 to job\n"), "");
}

TEST(MpirunReport, tells_what_stood_still) {
  const LostRankError stopped = stopped_rank(getpid(), 30);
  EXPECT_EQ(static_cast<int>(stopped.code()), 128 + SIGSTOP);
  EXPECT_EQ(stopped.rank(), -1) << "no rank in this test's environment";
  EXPECT_EQ(std::string(stopped.what()).rfind("mpirun on ", 0), 0u);
  EXPECT_NE(std::string(stopped.what()).find(") stood still for 30 s, stopped by a signal"), std::string::npos);
}

TEST(MpirunReport, passes_on_what_ranks_say_and_other_banners) {
  const std::string text = "warning: a\n" + banner("WARNING: no network of that name") +
                           "--- b ---\nst-mesh: error: c\n" + kRule + "\nopen end\n";
  MpirunReport report;
  EXPECT_EQ(filtered(report, text), text);
  EXPECT_FALSE(report.lost_rank());
}

TEST(MpirunReport, says_what_to_do) {
  EXPECT_EQ(describe_lost_rank({1, "n7", 9}).rfind("rank 1 on n7 was ended by signal 9 (Killed); out of memory?", 0),
            0u);
  EXPECT_NE(describe_lost_rank({0, "", 11}).find("rank 0 was ended by signal 11 (Segmentation fault); a defect"),
            std::string::npos);
}

}  // namespace
}  // namespace st
