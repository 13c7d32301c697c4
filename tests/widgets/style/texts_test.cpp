// SPDX-License-Identifier: GPL-3.0-or-later
#include "style/texts.h"

#include <QCoreApplication>
#include <QDirIterator>
#include <QEvent>
#include <QFile>
#include <QHash>
#include <QRegularExpression>
#include <QTranslator>
#include <QWidget>

#include <gtest/gtest.h>

#include "style/core_patterns.h"
#include "style/file_patterns.h"
#include "style/import_patterns.h"
#include "style/model_patterns.h"

namespace lvcalib::widgets::texts_test {
namespace {

// A catalogue of the test's own.
class Upside : public QTranslator {
 public:
  [[nodiscard]] QString translate(const char* context, const char* source, const char*,
                                  int) const override {
    if (qstrcmp(context, "Core") != 0) return {};
    return words_.value(QString::fromUtf8(source));
  }
  [[nodiscard]] bool isEmpty() const override { return false; }

 private:
  QHash<QString, QString> words_ = {
      {"scene %1: %2", "<%2> in %1"},
      {"%1 is known %2 times worse than the typical direction: %3", "%2-fold: %1 (%3)"},
      {"rotation about the camera's x axis", "RX"},
      {"%1: file not found", QString::fromUtf8("%1：NO FILE")},
      {"used", "in use"}};
};

class CoreTextTest : public ::testing::Test {
 protected:
  void SetUp() override { QCoreApplication::installTranslator(&upside_); }
  void TearDown() override { QCoreApplication::removeTranslator(&upside_); }
  Upside upside_;
};

TEST_F(CoreTextTest, WholeSentencesAndPatterns) {
  EXPECT_EQ(core_text(std::string("used")), "in use");
  EXPECT_EQ(core_text(std::string("nothing like it")), "nothing like it");
  EXPECT_EQ(core_text(std::string()), "");
  EXPECT_EQ(core_text(std::string("scene A: used")), "<in use> in A");
  EXPECT_EQ(core_text(std::string("rotation about the camera's x axis is known 7 times worse than "
                                  "the typical direction: add a scene")),
            "7-fold: RX (add a scene)");
}

TEST_F(CoreTextTest, ASentenceAboutAFileIsFoundWithAndWithoutItsName) {
  EXPECT_EQ(core_text(std::string("/a/b.pcd: file not found")),
            QString::fromUtf8("/a/b.pcd：NO FILE"));
  EXPECT_EQ(core_text(std::string("file not found")), "NO FILE");
  EXPECT_EQ(core_text(Error::input("file not found", "/a/b.pcd")), "/a/b.pcd: NO FILE");
}

TEST_F(CoreTextTest, WhatIsFilledInIsNotReadAsAPlace) {
  EXPECT_EQ(core_text(std::string("scene %2: 100 %1")), "<100 %1> in %2");
}

TEST(CoreText, WithoutACatalogueTheCoreSpeaks) {
  EXPECT_EQ(core_text(std::string("scene A: used")), "scene A: used");
}

// Each pattern's longest fixed part must stand in the core's sources, string by string.
TEST(CoreText, EveryPatternIsSomethingThatTheCoreSays) {
  QString sources;
  QDirIterator files(QStringLiteral(LVCALIB_SOURCE_DIR "/core"), {"*.cpp", "*.h"}, QDir::Files,
                     QDirIterator::Subdirectories);
  while (files.hasNext()) {
    QFile file(files.next());
    ASSERT_TRUE(file.open(QIODevice::ReadOnly));
    sources += QString::fromUtf8(file.readAll());
  }
  ASSERT_GT(sources.size(), 100'000);
  // Literals that follow each other are one; what printf fills in is a place.
  sources.remove(QRegularExpression("\"\\s*\""));
  sources.replace("%%", "%");
  static const QRegularExpression places(
      "%[0-9]|[:;,.()]|\\b(larger|smaller|farther|nearer)\\b|\\b(paper|circle)'s");
  std::vector<const char*> patterns(std::begin(kCorePatterns), std::end(kCorePatterns));
  patterns.insert(patterns.end(), std::begin(kModelPatterns), std::end(kModelPatterns));
  patterns.insert(patterns.end(), std::begin(kImportPatterns), std::end(kImportPatterns));
  patterns.insert(patterns.end(), std::begin(kFilePatterns), std::end(kFilePatterns));
  for (const char* pattern : patterns) {
    QString longest;
    for (const QString& part : QString::fromUtf8(pattern).split(places)) {
      // A sentence made by "…" + number + "…" is in pieces: its longest words must be there.
      if (part.trimmed().size() > longest.size()) longest = part.trimmed();
    }
    if (longest.size() < 4) continue;
    EXPECT_TRUE(sources.contains(longest)) << pattern << "\n  not found: " << longest.toStdString();
  }
}

TEST(FollowLanguage, SetsTextsNowAndOnEveryChange) {
  QWidget widget;
  int set = 0;
  follow_language(&widget, [&] { ++set; });
  EXPECT_EQ(set, 1);
  QEvent change(QEvent::LanguageChange);
  QCoreApplication::sendEvent(&widget, &change);
  EXPECT_EQ(set, 2);
  QEvent other(QEvent::PaletteChange);
  QCoreApplication::sendEvent(&widget, &other);
  EXPECT_EQ(set, 2);
}

}  // namespace
}  // namespace lvcalib::widgets::texts_test
