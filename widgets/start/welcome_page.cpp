// SPDX-License-Identifier: GPL-3.0-or-later
#include "start/welcome_page.h"

#include <QCommandLinkButton>
#include <QDir>
#include <QEvent>
#include <QFileInfo>
#include <QHBoxLayout>
#include <QLabel>
#include <QListWidget>
#include <QVBoxLayout>

namespace lvcalib::widgets {

WelcomePage::WelcomePage(QWidget* parent)
    : QWidget(parent),
      title_(new QLabel(this)),
      purpose_(new QLabel(this)),
      dataset_(new QCommandLinkButton(this)),
      project_(new QCommandLinkButton(this)),
      import_(new QCommandLinkButton(this)),
      import_files_(new QCommandLinkButton(this)),
      target_camera_(new QCommandLinkButton(this)),
      demo_(new QCommandLinkButton(this)),
      guide_(new QCommandLinkButton(this)),
      recent_title_(new QLabel(this)),
      recent_(new QListWidget(this)) {
  QFont font = title_->font();
  font.setPointSizeF(2.0 * font.pointSizeF());
  title_->setFont(font);
  purpose_->setWordWrap(true);
  recent_->setObjectName(QStringLiteral("recent"));
  recent_->setTextElideMode(Qt::ElideMiddle);
  recent_title_->setBuddy(recent_);
  auto* buttons = new QVBoxLayout;
  const std::pair<QCommandLinkButton*, const char*> named[] = {{import_, "import_recording"},
                                                               {import_files_, "import_files"},
                                                               {dataset_, "open_dataset"},
                                                               {project_, "open_project"},
                                                               {target_camera_, "target_camera"},
                                                               {demo_, "demo"},
                                                               {guide_, "guide"}};
  for (const auto& [button, name] : named) {
    button->setObjectName(QString::fromLatin1(name));
    buttons->addWidget(button);
  }
  buttons->addStretch();
  auto* list = new QVBoxLayout;
  list->addWidget(recent_title_);
  list->addWidget(recent_, 1);
  auto* columns = new QHBoxLayout;
  columns->addLayout(buttons, 2);
  columns->addSpacing(24);
  columns->addLayout(list, 3);
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(40, 32, 40, 32);
  layout->addWidget(title_);
  layout->addWidget(purpose_);
  layout->addSpacing(16);
  layout->addLayout(columns, 1);
  connect(dataset_, &QCommandLinkButton::clicked, this, &WelcomePage::open_dataset_wanted);
  connect(project_, &QCommandLinkButton::clicked, this, &WelcomePage::open_project_wanted);
  connect(import_, &QCommandLinkButton::clicked, this, &WelcomePage::import_wanted);
  connect(import_files_, &QCommandLinkButton::clicked, this, &WelcomePage::import_files_wanted);
  connect(target_camera_, &QCommandLinkButton::clicked, this, &WelcomePage::target_camera_wanted);
  connect(demo_, &QCommandLinkButton::clicked, this, &WelcomePage::demo_wanted);
  connect(guide_, &QCommandLinkButton::clicked, this, &WelcomePage::guide_wanted);
  connect(recent_, &QListWidget::itemActivated, this, [this](const QListWidgetItem* item) {
    Q_EMIT recent_wanted(item->data(Qt::UserRole).toString());
  });
  retranslate();
}

void WelcomePage::set_recent(const QStringList& paths) {
  recent_->clear();
  for (const QString& path : paths) {
    const QFileInfo info(path);
    auto* item = new QListWidgetItem(
        QStringLiteral("%1\n%2").arg(info.fileName(), QDir::toNativeSeparators(path)), recent_);
    item->setData(Qt::UserRole, path);
    item->setToolTip(path);
    if (!info.exists()) item->setForeground(palette().color(QPalette::Disabled, QPalette::Text));
  }
}

void WelcomePage::changeEvent(QEvent* event) {
  if (event->type() == QEvent::LanguageChange) retranslate();
  QWidget::changeEvent(event);
}

void WelcomePage::retranslate() {
  title_->setText(tr("LV-Calib Workbench"));
  purpose_->setText(
      tr("Finds how a camera and a LiDAR stand to each other from a few scenes of a "
         "printed board, says how sure it is, and shows why."));
  dataset_->setText(tr("Open a dataset"));
  dataset_->setDescription(tr("A folder with target.yaml, camera.yaml and scenes"));
  project_->setText(tr("Open a project"));
  project_->setDescription(tr("A dataset with your decisions about it (.lvcalib)"));
  import_->setText(tr("New from a recording"));
  import_->setDescription(tr("A ROS bag, rosbag2 or MCAP in which board and rig stood still"));
  import_files_->setText(tr("New from files"));
  import_files_->setDescription(tr("Images and clouds in folders, matched by name or by time"));
  target_camera_->setText(tr("Describe a target or a camera"));
  target_camera_->setDescription(tr("target.yaml and camera.yaml from what you know of both"));
  demo_->setText(tr("Try the demo"));
  demo_->setDescription(
      tr("Simulates four scenes with an effect hidden in them, and a tour to find it"));
  guide_->setText(tr("Guide"));
  guide_->setDescription(tr("From the printed board to a result, step by step"));
  recent_title_->setText(tr("Recent (or drop a folder or a recording on this window)"));
}

}  // namespace lvcalib::widgets

#include "moc_welcome_page.cpp"
