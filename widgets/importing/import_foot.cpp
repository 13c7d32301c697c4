// SPDX-License-Identifier: GPL-3.0-or-later
#include "importing/import_foot.h"

#include <QEvent>
#include <QHBoxLayout>
#include <QLabel>
#include <QProgressBar>
#include <QPushButton>
#include <QVBoxLayout>

#include "style/marks.h"
#include "style/texts.h"

namespace lvcalib::widgets {

ImportWarnings::ImportWarnings(QWidget* parent) : QListWidget(parent) {
  setObjectName(QStringLiteral("import_warnings"));
  setWordWrap(true);
  setSelectionMode(QAbstractItemView::NoSelection);
  setFocusPolicy(Qt::NoFocus);
  setMaximumHeight(72);
  hide();
}

void ImportWarnings::setWarnings(const QStringList& warnings) {
  clear();
  addItems(warnings);
  showMarks();
  setVisible(!warnings.isEmpty());
}

void ImportWarnings::showMarks() {
  for (int row = 0; row < count(); ++row) item(row)->setIcon(mark_icon(Mark::kDoubtful, palette()));
}

void ImportWarnings::changeEvent(QEvent* event) {
  QListWidget::changeEvent(event);
  if (event->type() == QEvent::PaletteChange) showMarks();
}

ImportFoot::ImportFoot(QWidget* parent)
    : QWidget(parent),
      problem_(new QLabel(this)),
      progress_(new QProgressBar(this)),
      progress_text_(new QLabel(this)),
      stop_(new QPushButton(this)),
      count_(new QLabel(this)),
      import_(new QPushButton(this)),
      close_(new QPushButton(this)) {
  const std::pair<QWidget*, const char*> named[] = {
      {problem_, "import_problem"}, {progress_, "import_progress"}, {stop_, "import_stop"},
      {count_, "import_count"},     {import_, "import_start"},      {close_, "import_close"}};
  for (const auto& [widget, name] : named) widget->setObjectName(QString::fromLatin1(name));
  problem_->setWordWrap(true);
  problem_->setTextFormat(Qt::PlainText);
  problem_->setTextInteractionFlags(Qt::TextSelectableByMouse | Qt::TextSelectableByKeyboard);
  progress_->setRange(0, 1000);
  progress_->setTextVisible(false);
  // Enter imports, and nothing else.
  for (QPushButton* button : {stop_, close_}) button->setAutoDefault(false);
  import_->setDefault(true);

  auto* running = new QHBoxLayout;
  running->addWidget(progress_text_, 1);
  running->addWidget(progress_, 1);
  running->addWidget(stop_);
  auto* buttons = new QHBoxLayout;
  buttons->addWidget(count_, 1);
  buttons->addWidget(import_);
  buttons->addWidget(close_);
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->addWidget(problem_);
  layout->addLayout(running);
  layout->addLayout(buttons);

  connect(import_, &QPushButton::clicked, this, &ImportFoot::importWanted);
  connect(stop_, &QPushButton::clicked, this, &ImportFoot::stopWanted);
  connect(close_, &QPushButton::clicked, this, &ImportFoot::closeWanted);
  follow_language(this, [this] { retranslate(); });
}

void ImportFoot::setProblem(const QString& problem) {
  QString text = problem.isEmpty() ? note_ : problem;
  if (!text.isEmpty()) text[0] = text[0].toUpper();
  problem_->setText(text);
  problem_->setVisible(!text.isEmpty());
}

void ImportFoot::noteWithoutCamera(const QString& dataset) {
  note_ = tr("%1 is written, without intrinsics: put a camera.yaml into it, then open it.")
              .arg(dataset);
}

void ImportFoot::setCount(const QString& count) {
  count_->setText(count);
}

void ImportFoot::setReady(bool ready) {
  import_->setEnabled(ready);
}

void ImportFoot::setBusy(bool busy, bool again) {
  again_ = again && !busy;
  progress_->setVisible(busy);
  stop_->setVisible(busy || again_);
  if (!busy) progress_text_->clear();
  retranslate();
}

void ImportFoot::begin(const QString& text) {
  note_.clear();
  setProgress(0.0, text);
}

void ImportFoot::setProgress(double fraction, const QString& text) {
  progress_->setValue(static_cast<int>(1000 * fraction));
  progress_text_->setText(text);
}

void ImportFoot::retranslate() {
  stop_->setText(again_ ? tr("&Look again") : tr("&Stop"));
  import_->setText(tr("Import and &calibrate"));
  close_->setText(tr("Close"));
}

}  // namespace lvcalib::widgets

#include "moc_import_foot.cpp"
