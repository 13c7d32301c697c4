// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/print_dialog.h"

#include <QComboBox>
#include <QDir>
#include <QFileInfo>
#include <QGridLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QSignalBlocker>
#include <QVBoxLayout>
#include <algorithm>

#include "base/file_io.h"
#include "style/texts.h"
#include "target/sheet.h"
#include "words/core_text.h"

namespace lvcalib::widgets {
namespace {

SheetFormat format_of(const QString& path) {
  const QString suffix = QFileInfo(path).suffix().toLower();
  if (suffix == QLatin1String("svg")) return SheetFormat::kSvg;
  return suffix == QLatin1String("png") ? SheetFormat::kPng : SheetFormat::kPdf;
}

}  // namespace

PrintDialog::PrintDialog(const std::optional<Target>& present, Choices& choices,
                         const QString& folder, QWidget* parent)
    : QDialog(parent),
      choices_(choices),
      folder_(folder),
      has_present_(present.has_value()),
      labels_{new QLabel(this), new QLabel(this), new QLabel(this)},
      board_(new QComboBox(this)),
      paper_(new QComboBox(this)),
      file_(new QLineEdit(this)),
      place_(new QPushButton(this)),
      text_(new QLabel(this)),
      write_(new QPushButton(this)),
      close_(new QPushButton(this)) {
  setObjectName(QStringLiteral("print_dialog"));
  setAttribute(Qt::WA_DeleteOnClose);
  if (present) boards_.push_back(*present);
  boards_.emplace_back();
  file_->setText(QDir::toNativeSeparators(QDir(folder).filePath(QStringLiteral("board.pdf"))));
  build();
  connect(board_, &QComboBox::currentIndexChanged, this, &PrintDialog::chooseBoard);
  connect(paper_, &QComboBox::currentIndexChanged, this, &PrintDialog::refresh);
  connect(file_, &QLineEdit::textChanged, this, &PrintDialog::refresh);
  connect(place_, &QPushButton::clicked, this, [this] {
    const QString path =
        choices_.file_to_export(this, file_->text(), tr("PDF (*.pdf);;SVG (*.svg);;PNG (*.png)"));
    if (!path.isEmpty()) file_->setText(QDir::toNativeSeparators(path));
  });
  connect(write_, &QPushButton::clicked, this, &PrintDialog::start);
  connect(close_, &QPushButton::clicked, this, &QDialog::close);
  connect(&runner_, &Runner::finished, this, &PrintDialog::refresh);
  connect(&runner_, &Runner::failed, this, [this](quint64, const QString& message) {
    error_ = Error::output(Message::verbatim(message.toStdString()));
    refresh();
  });
  follow_language(this, [this] { retranslate(); });
}

PrintDialog::~PrintDialog() {
  runner_.disconnect(this);
}

void PrintDialog::build() {
  resize(560, 220);
  const std::pair<QWidget*, const char*> named[] = {{board_, "print_board"},
                                                    {paper_, "print_paper"},
                                                    {file_, "print_file"},
                                                    {text_, "print_text"},
                                                    {write_, "print_start"}};
  for (const auto& [widget, name] : named) widget->setObjectName(QString::fromLatin1(name));
  text_->setWordWrap(true);
  text_->setTextFormat(Qt::PlainText);
  text_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  for (QPushButton* button : {place_, close_}) button->setAutoDefault(false);
  write_->setDefault(true);
  auto* form = new QGridLayout;
  QWidget* const fields[] = {board_, paper_, file_};
  for (int row = 0; row < 3; ++row) {
    labels_[row]->setBuddy(fields[row]);
    form->addWidget(labels_[row], row, 0);
    form->addWidget(fields[row], row, 1, 1, row < 2 ? 2 : 1);
  }
  form->addWidget(place_, 2, 2);
  form->setColumnStretch(1, 1);
  auto* buttons = new QHBoxLayout;
  buttons->addStretch();
  buttons->addWidget(write_);
  buttons->addWidget(close_);
  auto* layout = new QVBoxLayout(this);
  layout->addLayout(form);
  layout->addWidget(text_);
  layout->addStretch();
  layout->addLayout(buttons);
}

void PrintDialog::chooseBoard(int index) {
  error_.reset();
  if (index >= 0 && static_cast<std::size_t>(index) == boards_.size()) {
    const QString path = choices_.target_to_open(this, folder_);
    const auto file =
        path.isEmpty() ? Result<TargetFile>(Error::cancelled()) : read_target(path.toStdString());
    const QSignalBlocker quiet(board_);
    if (file) {
      boards_.push_back(file->target);
      board_names_ << path;
      board_->insertItem(index, QDir::toNativeSeparators(path));
      board_->setCurrentIndex(index);
    } else {
      board_->setCurrentIndex(last_board_);
      if (!path.isEmpty()) error_ = file.error();
    }
  }
  last_board_ = board_->currentIndex();
  refresh();
}

void PrintDialog::start() {
  error_.reset();
  written_.clear();
  const QString path = QDir::fromNativeSeparators(file_->text().trimmed());
  SheetOptions options;
  options.paper = paper_->currentData().toString().toStdString();
  runner_.start([this, path, options, target = boards_[static_cast<std::size_t>(last_board_)]](
                    const RunContext& context, const Runner::Post&) -> Runner::Deliver {
    const auto sheet = draw_sheet(target, format_of(path), options, context);
    if (!sheet) return [this, error = sheet.error()] { error_ = error; };
    if (Status s = write_file_atomically(path.toStdString(), *sheet); !s)
      return [this, error = s.error()] { error_ = error; };
    return [this, path] { written_ = path; };
  });
  refresh();
}

QString PrintDialog::layoutText() const {
  SheetOptions options;
  options.paper = paper_->currentData().toString().toStdString();
  const auto layout = lay_out_sheet(boards_[static_cast<std::size_t>(last_board_)], options);
  if (!layout) return core_text(layout.error());
  return tr("Board of %1 × %2 mm; pages: %3. Print without scaling (100 %) and measure the scale "
            "bar.")
      .arg(QString::number(layout->board_mm.x(), 'f', 0),
           QString::number(layout->board_mm.y(), 'f', 0))
      .arg(layout->page_count());
}

void PrintDialog::refresh() {
  if (paper_->count() == 0) return;  // Not filled yet.
  QString text = error_ ? core_text(*error_) : layoutText();
  if (!written_.isEmpty()) text = tr("Written: %1").arg(written_) + QLatin1Char('\n') + text;
  text_->setText(text);
  write_->setEnabled(!busy() && !file_->text().trimmed().isEmpty());
}

void PrintDialog::retranslate() {
  setWindowTitle(tr("Print the board"));
  labels_[0]->setText(tr("&Board:"));
  labels_[1]->setText(tr("&Paper:"));
  labels_[2]->setText(tr("&File:"));
  place_->setText(tr("P&lace…"));
  write_->setText(tr("&Write"));
  close_->setText(tr("Close"));
  {
    const QSignalBlocker a(board_), b(paper_);
    const int board = last_board_;
    const int paper = std::max(0, paper_->currentIndex());
    board_->clear();
    if (has_present_) board_->addItem(tr("of the open dataset"));
    board_->addItem(tr("Standard board: 4 × 4 tags with circles"));
    for (const QString& name : board_names_) board_->addItem(QDir::toNativeSeparators(name));
    board_->addItem(tr("Choose a target.yaml…"));
    board_->setCurrentIndex(board);
    paper_->clear();
    paper_->addItem(tr("one page of the board's size"), QStringLiteral("board"));
    for (const char* name : {"A0", "A1", "A2", "A3", "A4", "Letter"})
      paper_->addItem(QString::fromLatin1(name), QString::fromLatin1(name));
    paper_->setCurrentIndex(paper);
  }
  refresh();
}

}  // namespace lvcalib::widgets

#include "moc_print_dialog.cpp"
