// SPDX-License-Identifier: GPL-3.0-or-later
#include "views/figure_actions.h"

#include <QFile>
#include <QMenu>
#include <QSignalSpy>
#include <QTemporaryDir>
#include <QWidget>

#include <gtest/gtest.h>

namespace lvcalib::widgets::figure_actions_test {
namespace {

QImage picture() {
  QImage image(40, 30, QImage::Format_RGB32);
  image.fill(qRgb(1, 2, 3));
  return image;
}

Figure full_figure() {
  return {"thing", picture, [] { return image_as_pdf(picture()); },
          [] { return QByteArray("a\n1\n"); }};
}

QByteArray content(const QString& path) {
  QFile file(path);
  return file.open(QIODevice::ReadOnly) ? file.readAll() : QByteArray();
}

TEST(FigureActions, SavesByTheSuffix) {
  QWidget view;
  const FigureActions actions(&view, full_figure());
  const QTemporaryDir folder;
  ASSERT_TRUE(actions.save(folder.filePath("a.png")));
  EXPECT_EQ(QImage(folder.filePath("a.png")).pixel(3, 3), qRgb(1, 2, 3));
  ASSERT_TRUE(actions.save(folder.filePath("a.pdf")));
  EXPECT_TRUE(content(folder.filePath("a.pdf")).startsWith("%PDF"));
  ASSERT_TRUE(actions.save(folder.filePath("a.CSV")));
  EXPECT_EQ(content(folder.filePath("a.CSV")), "a\n1\n");
  EXPECT_EQ(actions.save(folder.filePath("a.gif")).error().kind, ErrorKind::kUsage);
  EXPECT_EQ(actions.save(folder.filePath("none/a.csv")).error().kind, ErrorKind::kOutput);
}

TEST(FigureActions, MenuAsksAndSavesAndSaysWhatFailed) {
  QWidget view;
  FigureActions actions(&view, full_figure());
  const QTemporaryDir folder;
  QString suggested;
  QString answer = folder.filePath("mine");
  actions.setFileChooser([&](QWidget*, const QString& name, const QString&) {
    suggested = name;
    return answer;
  });
  QMenu menu;
  actions.addTo(&menu);
  ASSERT_EQ(menu.actions().size(), 3);
  menu.actions()[2]->trigger();
  EXPECT_EQ(suggested, "thing.csv");
  EXPECT_EQ(content(folder.filePath("mine.csv")), "a\n1\n");  // The suffix is added.
  QSignalSpy failed(&actions, &FigureActions::failed);
  answer = "/proc/no/such";
  menu.actions()[0]->trigger();
  ASSERT_EQ(failed.size(), 1);
  EXPECT_TRUE(failed[0][0].toString().contains("/proc/no/such.png"));
  answer.clear();  // The user thought better of it.
  menu.actions()[0]->trigger();
  EXPECT_EQ(failed.size(), 1);
}

TEST(FigureActions, OffersWhatThereIs) {
  QWidget view;
  FigureActions actions(&view, {"x", picture, {}, {}});
  QMenu menu;
  actions.addTo(&menu);
  EXPECT_EQ(menu.actions().size(), 1);
  EXPECT_FALSE(actions.save("/tmp/x.csv"));
}

}  // namespace
}  // namespace lvcalib::widgets::figure_actions_test
