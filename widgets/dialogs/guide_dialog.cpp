// SPDX-License-Identifier: GPL-3.0-or-later
#include "dialogs/guide_dialog.h"

#include <QDialogButtonBox>
#include <QTextBrowser>
#include <QVBoxLayout>

#include "style/texts.h"

namespace lvcalib::widgets {

GuideDialog::GuideDialog(QWidget* parent) : QDialog(parent) {
  setAttribute(Qt::WA_DeleteOnClose);
  setObjectName(QStringLiteral("guide_dialog"));
  resize(640, 560);
  auto* browser = new QTextBrowser(this);
  follow_language(this, [this, browser] {
    setWindowTitle(tr("Guide"));
    browser->setMarkdown(tr(
        "# From the board to a result\n"
        "1. **Print the board** at 1:1 with `lvcalib target target.yaml -o board.pdf`, glue it "
        "on something flat and measure a tag.\n"
        "2. **Take three to ten scenes**: an image and a cloud each, the board at 2–4 m, turned "
        "differently each time, seen whole by both sensors.\n"
        "3. **Lay out the folder**: `target.yaml`, `camera.yaml`, "
        "`scenes/NAME/image.png` and `scenes/NAME/cloud.pcd`.\n"
        "4. **Open it and press F5.** No rough guess is needed.\n"
        "5. **Look**: every scene should be *used*; a scene whose px, mm or influence stands out "
        "deserves a look on the Scene page. Untick it and the result follows at once.\n"
        "6. **Export** with Ctrl+E.\n\n"
        "# Pages\n"
        "- **Scene**: cloud and image of the scene that is selected in the list, with what was "
        "found in them. A crop box helps where the board is not found.\n"
        "- **Refinement**: how each circle's centre was found, bin by bin.\n"
        "- **Extrinsic**: the pose, its standard deviations, how the scenes agree, and the same "
        "scenes solved by other methods.\n"
        "- **Boundary response**: how returns scatter at the circles' edges.\n\n"
        "# Keys\n"
        "F5 runs all, Esc cancels, Ctrl+Z undoes, Ctrl+1, Ctrl+2 … change the page, Ctrl+J "
        "rejects and Ctrl+U accepts the selected scenes, Space ticks and unticks.\n"));
  });
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Close, this);
  connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
  auto* layout = new QVBoxLayout(this);
  layout->addWidget(browser);
  layout->addWidget(buttons);
}

}  // namespace lvcalib::widgets
