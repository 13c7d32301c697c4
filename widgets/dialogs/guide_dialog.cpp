// SPDX-License-Identifier: GPL-3.0-or-later
#include "dialogs/guide_dialog.h"

#include <QDialogButtonBox>
#include <QScrollBar>
#include <QTextBlock>
#include <QTextBrowser>
#include <QTextFrame>
#include <QTimer>
#include <QVBoxLayout>

#include "style/texts.h"

namespace lvcalib::widgets {

GuideDialog::GuideDialog(int page, QWidget* parent)
    : QDialog(parent), browser_(new QTextBrowser(this)), page_(page) {
  setAttribute(Qt::WA_DeleteOnClose);
  setObjectName(QStringLiteral("guide_dialog"));
  resize(680, 600);
  browser_->setObjectName(QStringLiteral("guide_text"));
  follow_language(this, [this] { retranslate(); });
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Close, this);
  connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
  auto* layout = new QVBoxLayout(this);
  layout->addWidget(browser_);
  layout->addWidget(buttons);
}

// A chapter per heading of the first level: what to do, the Model page, then the other pages in the
// order of their tabs.
void GuideDialog::retranslate() {
  setWindowTitle(tr("Guide"));
  const QStringList chapters = {
      tr("# From the board to a result\n"
         "1. **Print the board** at 1:1 with *Tools › Print the board…*, glue it on something flat "
         "and measure a tag.\n"
         "2. **Take three to ten scenes**: the board at 2–4 m, turned differently each time, seen "
         "whole by both sensors.\n"
         "3. **Open them**: *File › New from recording…* makes a dataset of a bag; or lay out a "
         "folder with `target.yaml`, `camera.yaml`, `scenes/NAME/image.png` and "
         "`scenes/NAME/cloud.pcd` and open that.\n"
         "4. **Press F5.** No rough guess is needed.\n"
         "5. **Look**: every scene should be *used*; a scene whose px, mm or influence stands out "
         "deserves a look on the Scene page. Untick it and the result follows at once.\n"
         "6. **Ask what is missing** on the Model page.\n"
         "7. **Export** with Ctrl+E.\n"),
      tr("# Model\n"
         "Compare, locate, learn, add, watch: what the model misses, and what that does to the "
         "pose.\n\n"
         "- **Bars on top**: the error beyond the noise after each step, red where it is "
         "unexplained, green where an effect took it away, grey where chance alone may leave it. A "
         "click goes to a step; *Compare steps…* sets two of them side by side. Where the truth of "
         "a simulation is known, the distance to it stands beside the bars.\n"
         "- **Where it fails**, in the middle: residuals of a channel against whatever they may "
         "depend on, as a scatter with binned means or as maps over the image, the board and the "
         "directions. *Before* draws what was there before the last step. *Brush* selects "
         "measurements, which are then marked on the Scene page too; *Exclude these* leaves them "
         "out "
         "of all scenes.\n"
         "- **What is missing**, on the right: effects with the evidence of the scenes held out. "
         "*Add* takes one into the model, *Find all* goes on until nothing is missing. *Cannot be "
         "seen* lists effects that these scenes would not show, and how far they could still move "
         "the pose.\n"
         "- **The model**, on the left: its effects with their values. Untick one to take it out, "
         "hold a value to fix it, *Add…* enters an effect as a formula or a curve. *What if* draws "
         "an effect over the residuals before it is in the model.\n"
         "- \"One of several\" means that these scenes cannot tell effects apart; the text names "
         "the scene that would.\n"),
      tr("# Scene\n"
         "Cloud and image of the scene that is selected in the list, with what was found in them. "
         "A click in one view shows the same thing in the other.\n\n"
         "- **Brush** (L): draw a line about points, tags or circles to select them; Shift adds. "
         "*Exclude these* leaves them out, and *Take back* brings them back. A patch of the board "
         "can be left out of every scene: a stain, a screw, a bent corner.\n"
         "- What is not used is hatched and crossed out: red where the program refused it, violet "
         "where you did. *Use it all the same* overrules the program.\n"
         "- **Crop…** (C) helps where the board is not found.\n"),
      tr("# Refinement\n"
         "How each circle's centre was found, bin by bin: marks where the intensity crosses its "
         "middle level, and the fitted wave. A centred circle has a flat line at zero. A click "
         "enlarges a circle and says why bins were refused. Circles that the solve left out are "
         "struck through.\n"),
      tr("# Extrinsic\n"
         "The pose, its standard deviations and the verdict. *Residuals* has a column for each "
         "scene; red crosses are left out. Drag the dashed line down over the bars to see what the "
         "extrinsic would be without the scenes above it. *Methods* solves the same scenes in "
         "other "
         "ways; *Thresholds* shows what tags and circles miss the board's pose by, with the gate "
         "as "
         "a line to drag: what would be refused and where the extrinsic would go is told before it "
         "is decided. *All scenes* shows every board about the rig.\n"),
      tr("# Boundary response\n"
         "How returns scatter at the circles' edges: the transition of the intensity, pitch and "
         "yaw with their ellipse, and ranges off the plane. The table has the numbers for all "
         "scenes and each one. *Left out* lists what the program refused, with its reasons.\n"),
      tr("# Camera\n"
         "The intrinsics as given, as estimated with the extrinsic and from images alone, with "
         "their standard deviations, and what the images say against them. Every image is listed "
         "with what its corners miss the camera by.\n\n"
         "- **Add images…** takes images of the board without a cloud: they count for the camera "
         "alone. Bring the board to all parts of the image, turned another way each time.\n"
         "- **Calibrate the camera** needs the images only; distortion models are compared on "
         "images that they were not fitted to. *Save camera.yaml…* keeps it.\n"
         "- *Residuals* shows as arrows what the corners miss the camera by; *Uncertainty* how "
         "well "
         "a direction is known over the image.\n"
         "- Whether the extrinsic's solve takes the intrinsics as given or estimates them is an "
         "option of the parameters.\n"),
      tr("# Tools\n"
         "*Plan scenes* says where to hold the board next and how sure the extrinsic is then. "
         "*File "
         "› Watch* takes scenes as they come and shows the next pose in large letters. *Check on "
         "fresh data* lays the pose over pictures with or without a board and says whether edges "
         "of LiDAR and image agree; there a rough pose is also found by hand. *Compare with* sets "
         "two results side by side, *Correct clouds* takes the model's effects out of clouds, "
         "*Calibrate a camera* makes a camera.yaml of a folder of images, and "
         "the board is printed and described from the same menu.\n"),
      tr("# Keys\n"
         "F5 runs all, Esc cancels, Ctrl+Z undoes, Ctrl+1, Ctrl+2 … change the page, Ctrl+J "
         "rejects and Ctrl+U accepts the selected scenes, Space ticks and unticks, Alt+Up and "
         "Alt+Down move them in the list, F1 opens this guide at the page in view.\n")};
  browser_->setMarkdown(chapters.join(QLatin1Char('\n')));
  showChapter();
}

void GuideDialog::show_page(int page) {
  page_ = page;
  show();
  raise();
  activateWindow();
  QTimer::singleShot(0, this, &GuideDialog::showChapter);
}

void GuideDialog::showChapter() {
  constexpr int kModelTab = 4;
  const int chapter = page_ < 0            ? 0
                      : page_ == kModelTab ? 1
                      : page_ < kModelTab  ? page_ + 2
                                           : page_ + 1;
  // Room below, so that the last chapters too can stand at the top.
  QTextFrame* frame = browser_->document()->rootFrame();
  QTextFrameFormat format = frame->frameFormat();
  const double room = 0.7 * browser_->viewport()->height();
  if (format.bottomMargin() != room) {  // The text is laid out anew for it.
    format.setBottomMargin(room);
    frame->setFrameFormat(format);
  }
  int heading = -1;
  for (QTextBlock block = browser_->document()->begin(); block.isValid(); block = block.next()) {
    if (block.blockFormat().headingLevel() != 1 || ++heading != chapter) continue;
    // To the top of the view, not just into sight.
    browser_->moveCursor(QTextCursor::End);
    browser_->setTextCursor(QTextCursor(block));
    browser_->verticalScrollBar()->setValue(browser_->verticalScrollBar()->value() +
                                            browser_->cursorRect().top());
  }
}

void GuideDialog::showEvent(QShowEvent* event) {
  QDialog::showEvent(event);
  // Only now is it known how the text breaks into lines.
  QTimer::singleShot(0, this, &GuideDialog::showChapter);
}

}  // namespace lvcalib::widgets

#include "moc_guide_dialog.cpp"
