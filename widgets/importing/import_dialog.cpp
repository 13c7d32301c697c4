// SPDX-License-Identifier: GPL-3.0-or-later
#include "importing/import_dialog.h"

#include <QDoubleSpinBox>
#include <QFileInfo>
#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QScreen>
#include <QSignalBlocker>
#include <QSplitter>
#include <QVBoxLayout>
#include <algorithm>

#include "importing/import_foot.h"
#include "importing/import_form.h"
#include "importing/stretch_list.h"
#include "importing/time_line.h"
#include "importing/topic_list.h"
#include "style/texts.h"
#include "words/core_text.h"

namespace lvcalib::widgets {

ImportDialog::ImportDialog(Choices& choices, const QStringList& recent, QWidget* parent)
    : QDialog(parent),
      choices_(choices),
      title_(new QLabel(this)),
      other_(new QPushButton(this)),
      topics_(new TopicList(this)),
      form_(new ImportForm(choices, recent, this)),
      warnings_(new ImportWarnings(this)),
      time_line_(new TimeLine(this)),
      stretches_(new StretchList(this)),
      edges_(new QLabel(this)),
      first_(new QDoubleSpinBox(this)),
      last_(new QDoubleSpinBox(this)),
      as_found_(new QPushButton(this)),
      foot_(new ImportFoot(this)) {
  setObjectName(QStringLiteral("import_dialog"));
  setAttribute(Qt::WA_DeleteOnClose);
  setAcceptDrops(false);  // The window takes what is dropped.
  build();
  connectParts();
  follow_language(this, [this] { retranslate(); });
  refresh();
}

ImportDialog::~ImportDialog() {
  // They change while they go.
  for (QObject* part : std::initializer_list<QObject*>{stretches_, form_, &work_})
    part->disconnect(this);
}

void ImportDialog::build() {
  // Its buttons stay within a small screen.
  const QSize room = screen() != nullptr ? screen()->availableSize() : QSize(1080, 860);
  resize(QSize(1080, 860).boundedTo(room));
  const std::pair<QWidget*, const char*> named[] = {{title_, "import_title"},
                                                    {other_, "import_other"},
                                                    {first_, "stretch_first"},
                                                    {last_, "stretch_last"},
                                                    {as_found_, "as_found"}};
  for (const auto& [widget, name] : named) widget->setObjectName(QString::fromLatin1(name));
  title_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  QFont bold = title_->font();
  bold.setBold(true);
  title_->setFont(bold);
  for (QPushButton* button : {other_, as_found_}) button->setAutoDefault(false);

  auto* head = new QHBoxLayout;
  head->addWidget(title_, 1);
  head->addWidget(other_);
  auto* above = new QSplitter(Qt::Horizontal, this);
  above->setChildrenCollapsible(false);
  above->addWidget(topics_);
  above->addWidget(form_);
  above->setStretchFactor(0, 1);
  above->setSizes({600, 460});
  for (QDoubleSpinBox* edge : {first_, last_}) {
    edge->setDecimals(2);
    edge->setSingleStep(0.1);
    edge->setKeyboardTracking(false);  // A number is taken when it is complete.
  }
  edges_->setBuddy(first_);
  auto* edges = new QHBoxLayout;
  edges->addWidget(edges_);
  edges->addWidget(first_);
  edges->addWidget(new QLabel(QStringLiteral("–"), this));
  edges->addWidget(last_);
  edges->addWidget(as_found_);
  edges->addStretch();
  auto* lower = new QWidget(this);
  auto* lower_layout = new QVBoxLayout(lower);
  lower_layout->setContentsMargins(0, 0, 0, 0);
  lower_layout->addWidget(time_line_);
  lower_layout->addLayout(edges);
  lower_layout->addWidget(stretches_, 1);
  auto* parts = new QSplitter(Qt::Vertical, this);
  parts->setChildrenCollapsible(false);
  parts->addWidget(above);
  parts->addWidget(lower);
  parts->setStretchFactor(1, 1);
  auto* layout = new QVBoxLayout(this);
  layout->addLayout(head);
  layout->addWidget(warnings_);
  layout->addWidget(parts, 1);
  layout->addWidget(foot_);
}

void ImportDialog::connectParts() {
  connect(other_, &QPushButton::clicked, this, [this] {
    const QString path = choices_.recording_to_open(this, QFileInfo(path_).absolutePath());
    if (!path.isEmpty()) openRecording(path);
  });
  connect(form_, &ImportForm::topicsChanged, this, [this] { lookAgain(true); });
  connect(form_, &ImportForm::limitsChanged, this, [this] { lookAgain(false); });
  connect(form_, &ImportForm::boardChanged, this, [this] {
    stretches_->forgetBoards();
    showPictures();
    refresh();
  });
  connect(form_, &ImportForm::changed, this, &ImportDialog::refresh);
  connect(time_line_, &TimeLine::clicked, stretches_, &StretchList::toggle);
  connect(stretches_, &StretchList::takenChanged, this, &ImportDialog::showTaken);
  connect(stretches_, &QTreeWidget::currentItemChanged, this, [this] {
    time_line_->setCurrent(stretches_->indexOfTopLevelItem(stretches_->currentItem()));
    showEdges();
  });
  connect(time_line_, &TimeLine::edgesMoved, this, [this](int stretch, double first, double last) {
    stretches_->setCurrentItem(stretches_->topLevelItem(stretch));
    moveEdges(stretch, first, last);
  });
  for (QDoubleSpinBox* edge : {first_, last_}) {
    connect(edge, &QDoubleSpinBox::valueChanged, this, [this] {
      moveEdges(stretches_->indexOfTopLevelItem(stretches_->currentItem()), first_->value(),
                last_->value());
    });
  }
  connect(as_found_, &QPushButton::clicked, this, &ImportDialog::takeAsFound);
  connect(foot_, &ImportFoot::stopWanted, this, [this] {
    if (work_.busy()) {
      work_.cancel();
    } else if (opened_) {
      lookAgain(true);
    } else {
      openRecording(path_);
    }
  });
  connect(foot_, &ImportFoot::importWanted, this, &ImportDialog::startImport);
  connect(foot_, &ImportFoot::closeWanted, this, &QDialog::close);
  connect(this, &QDialog::finished, this, [this] { work_.cancel(); });
  connect(&work_, &RecordingWork::opened, this, &ImportDialog::takeOpened);
  connect(&work_, &RecordingWork::looked, this, &ImportDialog::takeLook);
  connect(&work_, &RecordingWork::glimpsed, time_line_, &TimeLine::addPicture);
  connect(&work_, &RecordingWork::pictured, stretches_, &StretchList::setPicture);
  connect(&work_, &RecordingWork::imported, this, &ImportDialog::takeImported);
  connect(&work_, &RecordingWork::failed, this, [this](const Error& error) {
    takeBackEdges();
    showProblem(error);
  });
  connect(&work_, &RecordingWork::cancelled, this, [this] {
    takeBackEdges();
    refresh();
  });
  connect(&work_, &RecordingWork::progressed, this,
          [this](const QString& stage, double fraction, const QString& text) {
            foot_->setProgress(fraction, stage == QLatin1String("look") ? tr("Looking for motion…")
                                         : stage == QLatin1String("write") ? text
                                                                           : tr("Reading…"));
          });
}

void ImportDialog::openRecording(const QString& path) {
  path_ = path;
  const QFileInfo info(path);
  if (info.fileName() == QLatin1String("metadata.yaml")) path_ = info.absolutePath();
  opened_.reset();
  look_.reset();
  moved_.clear();
  error_.reset();
  form_->clear();
  topics_->setRecording(nullptr);
  time_line_->clear();
  stretches_->setStretches({});
  foot_->begin(tr("Reading…"));
  work_.open(path_);
  showWarnings();
  retranslate();
  refresh();
}

void ImportDialog::takeOpened(const OpenedRecording& opened) {
  opened_ = opened;
  topics_->setRecording(opened.recording);
  form_->setRecording(opened);
  retranslate();
  showWarnings();
  lookAgain(true);
}

// Topics change what is read; limits only what is made of it.
void ImportDialog::lookAgain(bool with_topics) {
  if (!opened_) return;
  error_.reset();
  if (with_topics) {
    look_.reset();
    moved_.clear();
    showGlimpses();
  }
  work_.look(opened_->recording, options(), look_ ? look_->survey : nullptr);
  refresh();
}

// What there is to see, before the whole recording is read.
void ImportDialog::showGlimpses() {
  const TimeSpan span = opened_->recording->span();
  time_line_->clear();
  time_line_->setRecording(1e-9 * static_cast<double>(span.last_ns - span.first_ns), {}, {});
  const std::string wanted = options().topics.image;
  for (const std::size_t topic : opened_->candidates.images) {
    if (opened_->recording->topics()[topic].name != wanted) continue;
    work_.show_glimpses(opened_->recording, topic);
    return;
  }
}

ImportOptions ImportDialog::options() const {
  ImportOptions out = form_->options();
  out.moved_edges = moved_;
  return out;
}

void ImportDialog::moveEdges(int stretch, double first_s, double last_s) {
  if (!look_ || stretch < 0) return;
  const ImportedStretch& s = stretches_->stretches()[static_cast<std::size_t>(stretch)];
  const double found_s = 0.5 * (s.found_first_s + s.found_last_s);
  std::erase_if(moved_, [&](const MovedEdges& edges) { return edges.found_s == found_s; });
  moved_.push_back({found_s, first_s, last_s});
  lookAgain(false);
}

// The stretch that is looked at.
void ImportDialog::takeAsFound() {
  const int stretch = stretches_->indexOfTopLevelItem(stretches_->currentItem());
  if (!look_ || stretch < 0) return;
  const ImportedStretch& s = stretches_->stretches()[static_cast<std::size_t>(stretch)];
  std::erase_if(moved_, [&](const MovedEdges& edges) {
    return s.found_first_s <= edges.found_s && edges.found_s <= s.found_last_s;
  });
  lookAgain(false);
}

void ImportDialog::showEdges() {
  const int stretch = stretches_->indexOfTopLevelItem(stretches_->currentItem());
  const bool any = look_.has_value() && stretch >= 0;
  for (QWidget* part : std::initializer_list<QWidget*>{edges_, first_, last_})
    part->setEnabled(any);
  as_found_->setEnabled(any && stretches_->stretches()[static_cast<std::size_t>(stretch)].by_hand);
  if (!any) return;
  const ImportedStretch& s = stretches_->stretches()[static_cast<std::size_t>(stretch)];
  const QSignalBlocker a(first_), b(last_);
  const auto show = [&](QDoubleSpinBox* edge, bool last, double value) {
    const auto [least, most] = time_line_->rangeOf(stretch, last);
    edge->setRange(least, most);
    edge->setValue(value);
  };
  show(first_, false, s.first_s);
  show(last_, true, s.last_s);
}

void ImportDialog::takeLook(const RecordingLook& look) {
  look_ = look;
  moved_shown_ = moved_;
  showStretches();
  showWarnings();
  showPictures();
  refresh();
}

void ImportDialog::showStretches() {
  const TimeSpan span = opened_->recording->span();
  time_line_->setRecording(1e-9 * static_cast<double>(span.last_ns - span.first_ns), look_->motion,
                           look_->stretches);
  stretches_->setStretches(look_->stretches);
  time_line_->setCurrent(stretches_->indexOfTopLevelItem(stretches_->currentItem()));
  showEdges();
}

// Edges that were refused, or not waited for, are where they were.
void ImportDialog::takeBackEdges() {
  if (!look_) return;
  moved_ = moved_shown_;
  showStretches();
}

void ImportDialog::showPictures() {
  if (!look_ || !form_->target()) return;
  const ImportOptions options = form_->options();
  work_.show_pictures(opened_->recording, *look_, stretches_->withoutPicture(), *form_->target(),
                      options.camera ? options.camera : look_->survey->camera);
}

void ImportDialog::showTaken() {
  time_line_->setTaken(stretches_->taken());
  QStringList texts;
  for (int i = 0; i < stretches_->topLevelItemCount(); ++i) texts << stretches_->describe(i);
  time_line_->setTexts(texts);
  refresh();
}

void ImportDialog::showWarnings() {
  QStringList texts;
  const auto add = [&](const std::vector<Message>& warnings) {
    for (const Message& warning : warnings) {
      const QString text = core_text(warning);
      if (!texts.contains(text)) texts << text;
    }
  };
  if (opened_) add(opened_->warnings);
  if (look_) add(look_->warnings);
  warnings_->setWarnings(texts);
}

void ImportDialog::showProblem(const std::optional<Error>& error) {
  error_ = error;
  refresh();
}

void ImportDialog::startImport() {
  if (!look_ || !form_->target()) return;
  ImportOptions options = this->options();
  options.scene_times_s = stretches_->sceneTimes();
  error_.reset();
  foot_->begin();
  work_.import(opened_->recording, look_->survey, *form_->target(), options, form_->folder());
  refresh();
}

void ImportDialog::takeImported(const ImportSummary& summary, const QString& dataset) {
  if (!summary.has_camera) {
    foot_->noteWithoutCamera(dataset);
    refresh();
    return;
  }
  Q_EMIT imported(dataset, summary);
  close();
}

void ImportDialog::refresh() {
  const bool busy = work_.busy();
  foot_->setBusy(busy, !look_ && !path_.isEmpty());
  const std::vector<bool> taken = stretches_->taken();
  const bool any = std::find(taken.begin(), taken.end(), true) != taken.end();
  QString problem = error_ ? core_text(*error_) : QString();
  if (problem.isEmpty() && opened_ && !busy) problem = form_->problem();
  if (problem.isEmpty() && look_ && !busy && taken.empty()) {
    problem = tr("Nothing stands still: something moves in images or clouds all the time.");
  } else if (problem.isEmpty() && look_ && !busy && !any) {
    problem = tr("Tick the stretches that are to become scenes.");
  }
  foot_->setProblem(problem);
  form_->setEnabled(opened_.has_value());
  foot_->setReady(look_ && any && !busy && form_->target() && form_->problem().isEmpty());
  const int scenes = stretches_->expectedScenes();
  foot_->setCount(look_ ? tr("%1 of %2 still stretches become scenes").arg(scenes).arg(taken.size())
                        : QString());
}

void ImportDialog::retranslate() {
  setWindowTitle(tr("New from a recording"));
  QString title = QFileInfo(path_).fileName();
  if (opened_) {
    const TimeSpan span = opened_->recording->span();
    const double length_s = span.first_ns > span.last_ns
                                ? 0.0
                                : 1e-9 * static_cast<double>(span.last_ns - span.first_ns);
    title = tr("%1 – %2, %3 s")
                .arg(title, QString::fromStdString(opened_->recording->kind()),
                     QString::number(length_s, 'f', 1));
  }
  title_->setText(title);
  other_->setText(tr("&Other recording…"));
  edges_->setText(tr("&Edges of the stretch:"));
  as_found_->setText(tr("&As found"));
  as_found_->setToolTip(tr("The edges as they were found, where nothing moves in between"));
  for (QDoubleSpinBox* edge : {first_, last_}) {
    edge->setSuffix(tr(" s"));
    edge->setToolTip(
        tr("What lies between the edges becomes the scene; they can be dragged on the "
           "time line as well"));
  }
  showWarnings();
  showTaken();
}

}  // namespace lvcalib::widgets

#include "moc_import_dialog.cpp"
