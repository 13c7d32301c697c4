// SPDX-License-Identifier: GPL-3.0-or-later
// A program that is killed in the middle of saving loses nothing: a child process saves over and
// over and is killed at a random moment, and what it leaves must be the old or the new content.
#include <QTemporaryDir>
#include <csignal>
#include <filesystem>
#include <functional>

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/file_io.h"
#include "base/random.h"
#include "pipeline/project_file.h"

namespace lvcalib::save_kill_test {
namespace {

constexpr int kKills = 100;

// Two contents that differ in length: a mixture of them could not be taken for either.
Project project_of(const std::filesystem::path& dataset, bool long_one) {
  Project project;
  project.dataset = dataset;
  for (int k = 0; k < (long_one ? 400 : 3); ++k) {
    SceneDecision& scene = project.decisions.scenes["scene " + std::to_string(k)];
    scene.use = k % 2 == 0;
  }
  project.decisions.use_crops = long_one;
  return project;
}

// Runs `save` in a child process until it is killed, some moments after its first save.
void kill_while_saving(const std::function<void(bool)>& save, unsigned delay_us) {
  int ready[2];
  ASSERT_EQ(::pipe(ready), 0);
  const pid_t child = ::fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    for (bool long_one = false;; long_one = !long_one) {
      save(long_one);
      const char one = 1;
      if (!long_one && ::write(ready[1], &one, 1) != 1) ::_exit(1);
    }
  }
  ::close(ready[1]);  // So that a child that dies early is noticed.
  char byte = 0;
  EXPECT_EQ(::read(ready[0], &byte, 1), 1) << "the child could not save";
  ::usleep(delay_us);
  ::kill(child, SIGKILL);
  int status = 0;
  ::waitpid(child, &status, 0);
  ::close(ready[0]);
  EXPECT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL) << "it ended by itself";
}

TEST(SaveKilled, AProjectIsTheOldOrTheNewOne) {
  const QTemporaryDir folder;
  const std::filesystem::path path = folder.filePath("rig.lvcalib").toStdString();
  const std::filesystem::path dataset = folder.filePath("rig").toStdString();
  const std::string texts[] = {project_as_text(project_of(dataset, false), path.parent_path()),
                               project_as_text(project_of(dataset, true), path.parent_path())};
  ASSERT_NE(texts[0].size(), texts[1].size());
  Random random(11);
  int seen[2] = {0, 0};
  for (int k = 0; k < kKills; ++k) {
    kill_while_saving(
        [&](bool long_one) {
          if (!write_project(path, project_of(dataset, long_one))) ::_exit(2);
        },
        static_cast<unsigned>(random.uniform(0.0, 20'000.0)));
    const auto text = read_text_file(path, 1U << 20U);
    ASSERT_TRUE(text.ok()) << text.error().text();
    ASSERT_TRUE(*text == texts[0] || *text == texts[1]) << "kill " << k;
    ++seen[*text == texts[1]];
    const auto again = read_project(path);
    ASSERT_TRUE(again.ok()) << again.error().text();
    EXPECT_TRUE(again->warnings.empty());
  }
  // Both contents were met, so the kills fell between saves as well as within them.
  EXPECT_GT(seen[0], 0);
  EXPECT_GT(seen[1], 0);
}

}  // namespace
}  // namespace lvcalib::save_kill_test
