#include "io/file/journal.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "base/hash.h"
#include "unit/io/soft_limit.h"
#include "unit/io/temporary_directory.h"

namespace st {
namespace {

const WorkKey kRun = work_key(hash_hex("run", 3)), kOtherRun = work_key(hash_hex("another", 7));

Work work_at(FaceId face) { return {work_key(hash_hex(&face, sizeof face)), face}; }

Bytes bytes_of(int n, int value) { return Bytes(n, static_cast<std::byte>(value)); }

class JournalTest : public ::testing::Test {
 protected:
  Journal::Place place(int run = 1, double after = 0) const { return {folder(), kRun, run, 0, after}; }
  std::string output() const { return directory_ / "p.hdf"; }
  std::string folder() const { return journal_folder(output()); }
  std::string file(int run = 1) const { return folder() + "/" + std::to_string(run) + "-0"; }

  /// As if the process had been killed there: nothing is said of its end.
  void forget_end(int run = 1) const {
    constexpr int kHead = 104;
    std::filesystem::resize_file(file(run), std::filesystem::file_size(file(run)) - kHead);
  }

  TemporaryDirectory directory_;
};

TEST_F(JournalTest, gives_back_what_was_finished) {
  {
    Journal journal(place());
    for (const FaceId f : {3, 4}) {
      journal.begin(work_at(f));
      journal.finish(work_at(f), [&] { return bytes_of(1000, f); });
    }
  }
  const JournalReader reader(folder(), kRun);
  EXPECT_EQ(reader.n_done(), 2u);
  EXPECT_EQ(reader.next_run(), 2);
  EXPECT_EQ(reader.result(work_at(4).key), bytes_of(1000, 4));
  EXPECT_FALSE(reader.result(work_at(5).key));
}

TEST_F(JournalTest, does_not_fit_another_run) {
  {
    Journal journal(place());
    journal.finish(work_at(3), [&] { return bytes_of(10, 1); });
  }
  const JournalReader reader(folder(), kOtherRun);
  EXPECT_TRUE(reader.is_empty());
  EXPECT_EQ(reader.next_run(), 2) << "its file must not be written over";
}

TEST_F(JournalTest, passes_over_a_torn_end) {
  {
    Journal journal(place());
    journal.finish(work_at(3), [&] { return bytes_of(10, 1); });
    journal.finish(work_at(4), [&] { return bytes_of(10, 2); });
  }
  forget_end();
  const auto whole = std::filesystem::file_size(file());
  for (const auto cut : {1, 9, 10, 11, 60, 113}) {
    std::filesystem::resize_file(file(), whole - cut);
    const JournalReader reader(folder(), kRun);
    EXPECT_EQ(reader.n_done(), 1u) << cut;
    EXPECT_TRUE(reader.result(work_at(3).key)) << cut;
  }
}

TEST_F(JournalTest, tells_the_faces_under_way_while_its_process_lives) {
  const auto faces = [&](int rank) { return faces_under_way(output(), rank); };
  EXPECT_TRUE(faces(0).empty()) << "no journal";
  {
    Journal journal(place());
    journal.begin(work_at(9));
  }
  Journal journal(place(10));
  for (const FaceId f : {7, 5, 3}) journal.begin(work_at(f));
  journal.begin(work_at(kNone));
  journal.finish(work_at(5), [&] { return bytes_of(10, 1); });
  EXPECT_EQ(faces(0), (std::vector<FaceId>{3, 7})) << "of the latest run alone";
  EXPECT_TRUE(faces(1).empty()) << "another rank";
}

TEST_F(JournalTest, does_not_believe_changed_bytes) {
  {
    Journal journal(place());
    journal.finish(work_at(3), [&] { return bytes_of(10, 1); });
  }
  forget_end();
  {
    std::fstream f(file(), std::ios::in | std::ios::out | std::ios::binary);
    f.seekp(-5, std::ios::end);
    f.put('x');
  }
  EXPECT_FALSE(JournalReader(folder(), kRun).result(work_at(3).key));
}

TEST_F(JournalTest, suspects_what_was_under_way_at_an_unexplained_end) {
  for (const int run : {1, 2}) {
    {
      Journal journal(place(run));
      journal.begin(work_at(3));
      journal.begin(work_at(10 + run));
      journal.begin(work_at(20));
      journal.finish(work_at(20), [&] { return bytes_of(10, 1); });
    }
    forget_end(run);
    const JournalReader reader(folder(), kRun);
    EXPECT_EQ(reader.deaths().at(work_at(3).key), run);
    EXPECT_FALSE(reader.deaths().contains(work_at(20).key));
    EXPECT_EQ(reader.crashes().contains(3), run == JournalReader::kMostDeaths);
    EXPECT_FALSE(reader.crashes().contains(10 + run));
  }
}

TEST_F(JournalTest, suspects_nothing_after_an_orderly_end) {
  Journal(place()).begin(work_at(3));
  EXPECT_TRUE(JournalReader(folder(), kRun).deaths().empty());
}

TEST_F(JournalTest, counts_what_ran_out_of_memory) {
  for (const int run : {1, 2}) {
    Journal journal(place(run));
    journal.begin(work_at(3));
    journal.fail(work_at(3));
  }
  EXPECT_EQ(JournalReader(folder(), kRun).crashes(), (std::map<FaceId, int>{{3, SIGKILL}}));
}

TEST_F(JournalTest, suspects_still_what_was_left_out_and_noted_as_done) {
  for (const int run : {1, 2}) {
    Journal journal(place(run));
    journal.begin(work_at(3));
    journal.fail(work_at(3));
  }
  {
    Journal journal(place(3));
    journal.finish(work_at(3), [&] { return bytes_of(10, 1); });
  }
  const JournalReader reader(folder(), kRun);
  EXPECT_EQ(reader.crashes(), (std::map<FaceId, int>{{3, SIGKILL}}));
  EXPECT_TRUE(reader.deaths().empty()) << "it is not tried again";
}

TEST_F(JournalTest, keeps_only_files_open_that_have_results) {
  const auto n_open = [] {
    return std::distance(std::filesystem::directory_iterator("/proc/self/fd"), std::filesystem::directory_iterator());
  };
  for (const int run : {1, 2, 3, 4, 5}) {
    Journal journal(place(run));
    journal.begin(work_at(run));
    if (run == 3) journal.finish(work_at(run), [&] { return bytes_of(10, 1); });
  }
  const auto n_before = n_open();
  const JournalReader reader(folder(), kRun), other(folder(), kOtherRun);
  EXPECT_EQ(n_open(), n_before + 1);
  EXPECT_TRUE(reader.result(work_at(3).key));
}

TEST_F(JournalTest, blames_the_face_of_a_crash_alone) {
  {
    Journal journal(place(1, 1000));
    journal.begin(work_at(3));
    journal.begin(work_at(4));
    EXPECT_FALSE(std::filesystem::exists(folder())) << "too early";
    EXPECT_TRUE(note_crash(4, SIGSEGV));
  }
  const JournalReader reader(folder(), kRun);
  EXPECT_EQ(reader.crashes(), (std::map<FaceId, int>{{4, SIGSEGV}}));
  EXPECT_TRUE(reader.deaths().empty());
  EXPECT_EQ(count_deaths(output()), 1u);
  EXPECT_FALSE(note_crash(4, SIGSEGV)) << "no journal is open";
}

TEST_F(JournalTest, leaves_nothing_of_a_short_run) {
  {
    Journal journal(place(1, 1000));
    journal.begin(work_at(3));
    journal.finish(work_at(3), [&] { return bytes_of(10, 1); });
    note_end();
  }
  EXPECT_FALSE(std::filesystem::exists(folder()));
}

TEST_F(JournalTest, that_starts_late_names_what_is_under_way) {
  {
    Journal journal(place(1, 0.01));
    journal.begin(work_at(3));
    while (!std::filesystem::exists(file()) || std::filesystem::file_size(file()) < 200) usleep(1000);
  }
  forget_end();
  EXPECT_EQ(JournalReader(folder(), kRun).deaths().size(), 1u);
}

TEST_F(JournalTest, of_a_run_that_lives_is_in_use) {
  const Journal journal(place());
  EXPECT_TRUE(JournalReader(folder(), kRun).is_in_use());
}

TEST_F(JournalTest, that_cannot_be_written_is_given_up) {
  std::ofstream(folder()) << "a file where the folder should be";
  Journal journal(place());
  journal.begin(work_at(3));
  journal.finish(work_at(3), [&] { return bytes_of(10, 1); });
  EXPECT_TRUE(JournalReader(folder(), kRun).is_empty());
}

TEST_F(JournalTest, on_a_full_disk_leaves_no_folder) {
  for (const rlim_t most : {10, 200}) {  // the head of the file does not fit, or the first result
    const FullDisk full(most);
    Journal journal(place());
    journal.begin(work_at(3));
    journal.finish(work_at(3), [&] { return bytes_of(1000, 1); });
    EXPECT_FALSE(std::filesystem::exists(folder())) << most;
  }
}

TEST_F(JournalTest, neither_waits_for_a_pipe_nor_touches_files_of_others) {
  std::filesystem::create_directory(folder());
  ASSERT_EQ(mkfifo(file(1).c_str(), 0600), 0);
  write_bytes(file(2),
              "not of a journal, and longer than the first record of one would be: as long as this, and longer");
  std::filesystem::create_symlink("/dev/zero", file(3));
  std::filesystem::create_directory(file(4));
  for (const char* name : {"2147483647-0", "99999999999999999999-0", "1000000-0", "5-", "-5", "1-2-3", "0-0"})
    write_bytes(folder() + "/" + name, "");
  const JournalReader reader(folder(), kRun);
  EXPECT_TRUE(reader.is_empty());
  EXPECT_FALSE(reader.is_in_use());
  EXPECT_EQ(reader.next_run(), 5);
  EXPECT_EQ(count_deaths(output()), 1u) << "of what might be one";
  EXPECT_TRUE(faces_under_way(output(), 0).empty());
  remove_journal(output());
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder()), {}), 11);
}

TEST_F(JournalTest, does_not_believe_a_result_that_was_pasted_from_elsewhere) {
  {
    Journal journal(place());
    journal.finish(work_at(3), [&] { return bytes_of(10, 1); });
  }
  constexpr int kHead = 104, kSum = 96, kFace = 16, kKey = 32;  // bytes of the record's head
  std::string bytes = read_bytes(file());
  std::string pasted = bytes.substr(kHead, kHead + 10);
  const WorkKey other = work_at(4).key;
  std::copy(other.begin(), other.end(), pasted.begin() + kKey);
  pasted[kFace] = 4;
  std::uint64_t sum = 0xcbf29ce484222325u;
  for (int i = 0; i < kSum; ++i) sum = (sum ^ static_cast<unsigned char>(pasted[i])) * 0x100000001b3u;
  std::memcpy(pasted.data() + kSum, &sum, sizeof sum);
  write_bytes(file(), bytes.insert(kHead, pasted));
  const JournalReader reader(folder(), kRun);
  EXPECT_EQ(reader.n_done(), 2u);
  EXPECT_TRUE(reader.result(work_at(3).key));
  EXPECT_FALSE(reader.result(work_at(4).key));
}

TEST_F(JournalTest, is_removed_with_its_folder) {
  Journal(place()).begin(work_at(3));
  EXPECT_TRUE(std::filesystem::exists(folder()));
  remove_journal(output());
  EXPECT_FALSE(std::filesystem::exists(folder()));
}

}  // namespace
}  // namespace st
