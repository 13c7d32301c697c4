// SPDX-License-Identifier: GPL-3.0-or-later
#include "runner/autosave.h"

#include <QDir>
#include <QFile>
#include <QSignalSpy>
#include <QTemporaryDir>

#include <gtest/gtest.h>

#include "base/file_io.h"

namespace lvcalib::widgets::autosave_test {
namespace {

Project example() {
  Project project{"/somewhere/dataset", {}, {}};
  project.decisions.scenes["A"].use = false;
  return project;
}

TEST(Autosave, IsWrittenSoonAndGoesWhenNothingIsUnsaved) {
  QTemporaryDir folder;
  Autosave autosave(folder.filePath("data"));
  QSignalSpy written(&autosave, &Autosave::written);
  autosave.keep(example(), "/home/p.lvcalib");
  EXPECT_FALSE(QFile::exists(autosave.file()));
  ASSERT_TRUE(written.wait(5000));
  EXPECT_TRUE(QFile::exists(autosave.file()));
  EXPECT_TRUE(Autosave::find(folder.filePath("data")).isEmpty()) << "of a running program";
  autosave.clear();
  EXPECT_FALSE(QFile::exists(autosave.file()));
}

TEST(Autosave, FindsWhatEndedProgramsLeftAndNothingElse) {
  QTemporaryDir folder;
  Autosave autosave(folder.path());
  QSignalSpy written(&autosave, &Autosave::written);
  autosave.keep(example(), "/home/p.lvcalib");
  ASSERT_TRUE(written.wait(5000));
  // Above the largest process id that the system gives.
  ASSERT_TRUE(QFile::copy(autosave.file(), folder.filePath("autosave-99999999.lvcalib")));
  for (const char* name : {"autosave-99999998.lvcalib", "autosave-x.lvcalib", "other.lvcalib"}) {
    ASSERT_TRUE(write_file_atomically(folder.filePath(name).toStdString(), "no project").ok());
  }
  const auto found = Autosave::find(folder.path());
  ASSERT_EQ(found.size(), 1);
  EXPECT_EQ(found.first().project_path, "/home/p.lvcalib");
  EXPECT_EQ(found.first().project.dataset, "/somewhere/dataset");
  EXPECT_FALSE(decision_of(found.first().project.decisions, "A").use);
  Autosave::discard(found.first());
  EXPECT_TRUE(Autosave::find(folder.path()).isEmpty());
}

TEST(Autosave, APlaceThatCannotBeWrittenIsReported) {
  QTemporaryDir folder;
  ASSERT_TRUE(write_file_atomically(folder.filePath("file").toStdString(), "in the way").ok());
  Autosave autosave(folder.filePath("file"));
  QSignalSpy failed(&autosave, &Autosave::failed);
  autosave.keep(example(), {});
  ASSERT_TRUE(failed.wait(5000));
  EXPECT_TRUE(failed.first().first().toString().contains("file"));
}

}  // namespace
}  // namespace lvcalib::widgets::autosave_test
