// SPDX-License-Identifier: GPL-3.0-or-later
// The language is changed from the menu while everything is open: nothing may stay in English.
#include <QDialog>
#include <QLabel>
#include <QPushButton>
#include <QRegularExpression>
#include <QTabWidget>
#include <QTemporaryDir>
#include <QTreeWidget>
#include <algorithm>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "dialogs/error_dialog.h"
#include "model/user_effect.h"
#include "report/result_file.h"
#include "runner/demo.h"
#include "tools/watch_window.h"
#include "views/color_bar.h"
#include "widgets/importing/recorded_walk.h"
#include "widgets/modelling/model_example.h"
#include "widgets/support/visible_texts.h"
#include "widgets/workbench/main_window_fixture.h"
#include "words/core_text.h"
#include "workbench/language.h"

namespace lvcalib::retranslation_test {
namespace {

using test::find;
using test::trigger;
using test::wait_until;

// Names, units, file names and keys are the same in every language.
const std::set<QString>& same_everywhere() {
  static const std::set<QString> words = {
      "Calib",   "LiDAR",   "AprilTag",   "AprilGrid", "YAML",   "JSON",     "PNG",         "PDF",
      "CSV",     "HTML",    "SVD",        "PnP",       "RMS",    "IMU",      "SLAM",        "ROS",
      "OpenGL",  "Mesa",    "Huber",      "Ctrl",      "Alt",    "Up",       "Down",        "Shift",
      "Esc",     "Home",    "mrad",       "ppm",       "kxy",    "blooming", "rad",         "deg",
      "lvcalib", "English", "GPL",        "BSD",       "Clause", "later",    "tagSize",     "nat",
      "LVI",     "SAM",     "camchain",   "LIVO",      "FAST",   "LIVE",     "FileStorage", "Rcl",
      "Pcl",     "rvec",    "tvec",       "cos",       "sin",    "Del",      "raw",         "demo",
      "dataset", "target",  "CameraInfo", "MCAP",      "bag",    "rosbag",   "Letter",      "MiB"};
  return words;
}

// English words of a text, after what is the same in every language is taken out.
QStringList english_words(QString text) {
  static const QRegularExpression code("<code>.*?</code>|<style>.*?</style>|<[^>]*>");
  // Paths, file names, identifiers, format specifiers: anything with . / _ * or a digit in it;
  // and topics.
  static const QRegularExpression names(
      "[^\\s，。：；（）]*[A-Za-z0-9_]+[./_*0-9:][^\\s，。：；（）]*|(?<!\\w)/[A-Za-z_/]+");
  static const QRegularExpression word("[A-Za-z]{3,}");
  text.remove(code);
  text.replace(QLatin1String("&nbsp;"), QLatin1String(" "));
  text.remove(names);
  QStringList out;
  for (auto i = word.globalMatch(text); i.hasNext();) {
    const QString found = i.next().captured();
    if (!same_everywhere().contains(found)) out << found;
  }
  return out;
}

void choose_language(const QMainWindow& window, const QString& code) {
  for (QAction* action : window.findChildren<QAction*>(QStringLiteral("language"))) {
    if (action->data().toString() == code) action->trigger();
  }
}

class RetranslationTest : public ::testing::Test {
 protected:
  void SetUp() override {
    const QString dataset = folder_.filePath(QStringLiteral("dataset"));
    ASSERT_TRUE(widgets::make_demo(dataset.toStdString(), test::small_demo(), {}).ok());
    settings_ = std::make_unique<widgets::AppSettings>(folder_.filePath("settings"));
    window_ = std::make_unique<widgets::MainWindow>(*settings_, answers_);
    window_->show();
    choose_language(*window_, "en");
    window_->open(dataset);
    ASSERT_TRUE(wait_until([&] { return window_->workspace().is_open(); }));
  }
  void TearDown() override {
    window_.reset();
    widgets::use_language("en");
    EXPECT_TRUE(widgets::Runner::wait_for_workers(60'000));
  }

  // Calibrates, leaves a scene out, visits every page and opens every dialog that stays open.
  void show_everything() {
    ASSERT_TRUE(trigger(*window_, "run"));
    ASSERT_TRUE(test::wait_for_result(*window_));
    look_at_every_page();
    window_->workspace().set_use({window_->workspace().missing_scenes() + QStringList{"02"}},
                                 false);
    ASSERT_TRUE(test::wait_for_result(*window_));
    for (const char* name : {"results", "guide", "about"}) ASSERT_TRUE(trigger(*window_, name));
    const auto written = folder_.filePath(QStringLiteral("earlier")).toStdString();
    ASSERT_TRUE(write_results(*window_->workspace().result(), written).ok());
    answers_.other_result = QString::fromStdString(written + "/result.json");
    for (const char* name : {"compare_results", "correct_clouds", "print_board"})
      ASSERT_TRUE(trigger(*window_, name));
    ASSERT_TRUE(trigger(*window_, "check_fresh_data"));
    ASSERT_TRUE(wait_until([&] {
      return find<QLabel>(*window_, "check_verdict")->text().contains(QLatin1String("px"));
    }));
    find<QPushButton>(*window_, "compare_file")->click();
    ASSERT_TRUE(wait_until(
        [&] { return find<QTreeWidget>(*window_, "compare_table")->topLevelItemCount() == 6; }));
    ASSERT_TRUE(trigger(*window_, "plan_scenes"));
    find<QPushButton>(*window_, "plan_start")->click();
    ASSERT_TRUE(wait_until(
        [&] { return find<QTreeWidget>(*window_, "plan_table")->topLevelItemCount() > 0; }));
    ASSERT_TRUE(trigger(*window_, "watch_dataset"));
    auto* watch = window_->findChild<widgets::WatchWindow*>();
    ASSERT_TRUE(wait_until([&] { return watch->nextPose().has_value(); }));
    answers_.recording = test::small_walk().path;
    ASSERT_TRUE(trigger(*window_, "import_recording"));
    ASSERT_TRUE(wait_until([&] {
      auto* stretches = find<QTreeWidget>(*window_, "stretches");
      const auto* last = stretches->topLevelItem(stretches->topLevelItemCount() - 1);
      return last != nullptr && !last->text(3).isEmpty();
    }));
    const auto* result = window_->workspace().result().get();
    auto* error = new widgets::ErrorDialog(
        Error::untrusted(
            Message("the scenes determine only %1 of 6 directions of the extrinsic", 5),
            result->dataset, Message("add a scene with the board nearer and tilted")),
        window_.get());
    error->show();
    QTest::qWait(20);
  }

  // A page is put into words when it is looked at.
  void look_at_every_page() {
    auto* pages = find<QTabWidget>(*window_, "pages");
    for (int k = 0; k < pages->count(); ++k) {
      // The model starts when its page is seen, and how far it gets depends on the machine; its
      // texts have their own tests.
      if (pages->widget(k)->objectName() == "model_page") continue;
      pages->setCurrentIndex(k);
      QTest::qWait(20);
      for (auto* tabs : pages->widget(k)->findChildren<QTabWidget*>()) {
        for (int tab = 0; tab < tabs->count(); ++tab) tabs->setCurrentIndex(tab);
        tabs->setCurrentIndex(0);
      }
    }
  }

  // Clouds get their legends from the background.
  void wait_for_legends(const QString& old_script) {
    const QRegularExpression old(old_script);
    wait_until(
        [&] {
          const auto bars = window_->findChildren<widgets::ColorBar*>();
          return std::none_of(bars.begin(), bars.end(), [&](const widgets::ColorBar* bar) {
            return bar->accessibleName().contains(old);
          });
        },
        10'000);
  }

  QTemporaryDir folder_;
  test::Answers answers_;
  std::unique_ptr<widgets::AppSettings> settings_;
  std::unique_ptr<widgets::MainWindow> window_;
};

TEST_F(RetranslationTest, NoEnglishIsLeftAfterASwitchToChinese) {
  show_everything();
  const std::size_t before = test::TextCollector(*window_).texts().size();
  ASSERT_GT(before, 400U);
  choose_language(*window_, "zh_CN");
  look_at_every_page();
  QTest::qWait(500);  // What is out of sight follows.
  wait_for_legends("[A-Za-z]{3}");
  const std::vector<test::SaidText> said = test::TextCollector(*window_).texts();
  EXPECT_GE(said.size() + 4, before) << "only the status line may have fallen silent";
  for (const test::SaidText& text : said) {
    EXPECT_THAT(english_words(text.text), ::testing::IsEmpty())
        << text.where.toStdString() << " says: " << text.text.toStdString();
  }
}

TEST_F(RetranslationTest, BackToEnglishNoChineseIsLeft) {
  choose_language(*window_, "zh_CN");
  show_everything();
  choose_language(*window_, "en");
  look_at_every_page();
  QTest::qWait(500);
  wait_for_legends("\\p{Han}");
  static const QRegularExpression han("\\p{Han}");
  const std::vector<test::SaidText> said = test::TextCollector(*window_).texts();
  for (const test::SaidText& text : said) {
    if (text.text == QString::fromUtf8("简体中文")) continue;
    EXPECT_FALSE(text.text.contains(han))
        << text.where.toStdString() << " says: " << text.text.toStdString();
  }
}

// What the Model page says of effects: suggestions, verdicts, the model itself.
TEST(ModelSentences, AreChineseInChinese) {
  const test::ModelExample& example = test::model_example();
  std::vector<Message> said;
  for (const EffectProposal& p : example.missing->proposals) said.push_back(p.finding.explanation);
  const auto after = rank_effects(*example.mended, {});
  ASSERT_TRUE(after.ok());
  for (const EffectProposal& p : after->proposals) said.push_back(p.finding.explanation);
  const Discovery found = as_discovery({example.base, example.mended}, &*after);
  for (const EffectFinding& f : found.effects) said.push_back(f.explanation);
  for (const char* spec : {"range_walk", "no_effect", "channel_range_offset"}) {
    const auto error = add_effect(example.mended, spec, 0.0, {});
    if (!error) said.push_back(error.error().message);
  }
  for (const char* text :
       {"formula:range:a=range", "formula:range:a*rnge", "formula:range:range",
        "curve:range:azimut", "curve:rang:azimuth", "curve:range:print,azimuth", "curve:range"}) {
    const auto parsed = parse_user_effect(text);
    if (!parsed) said.push_back(parsed.error().message);
  }
  EXPECT_GT(said.size(), 60U);
  widgets::use_language("zh_CN");
  // What the user typed or may type, and the names of parameters and units.
  static const QRegularExpression quoted(
      "“[^”]*”|：print |corner、range、boundary 或 intensity|ppm|nats|[\\w²′ψ]+ = ");
  for (const Message& sentence : said) {
    const std::string english = sentence.text();
    const QString chinese = widgets::core_text(sentence);
    EXPECT_TRUE(chinese.contains(QRegularExpression("\\p{Han}"))) << english;
    EXPECT_THAT(english_words(QString(chinese).remove(quoted)), ::testing::IsEmpty())
        << english << "\n  is said as: " << chinese.toStdString();
  }
  widgets::use_language("en");
}

TEST(EnglishWords, AreFoundBesideNamesAndNumbers) {
  EXPECT_THAT(english_words(QString::fromUtf8("角点 RMS (px)")), ::testing::IsEmpty());
  EXPECT_THAT(english_words("corner RMS (px)"), ::testing::ElementsAre("corner"));
  EXPECT_THAT(english_words(QString::fromUtf8("<p>打开 target.yaml</p><code>a.b c</code>")),
              ::testing::IsEmpty());
  EXPECT_THAT(english_words(QString::fromUtf8("结果：two scenes")),
              ::testing::ElementsAre("two", "scenes"));
}

}  // namespace
}  // namespace lvcalib::retranslation_test
