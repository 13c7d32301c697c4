// SPDX-License-Identifier: GPL-3.0-or-later
#include "runner/report_writer.h"

#include <filesystem>
#include <utility>

#include "base/file_io.h"
#include "report/html_report.h"
#include "words/core_text.h"

namespace lvcalib::widgets {

ReportWriter::ReportWriter(QObject* parent) : QObject(parent) {
  connect(&runner_, &Runner::progressed, this,
          [this](quint64, const QString& stage, double fraction, const QString& text) {
            Q_EMIT progressed(stage, fraction, text);
          });
  connect(&runner_, &Runner::cancelled, this, &ReportWriter::cancelled);
  connect(&runner_, &Runner::failed, this, [this](quint64, const QString& message) {
    Q_EMIT failed(Error::output(Message::verbatim(message.toStdString())));
  });
}

void ReportWriter::write(std::shared_ptr<const CalibrationResult> result,
                         std::shared_ptr<const Discovery> discovery, const QString& path,
                         const FrameNames& frames) {
  runner_.start([this, result = std::move(result), discovery = std::move(discovery), path, frames](
                    const RunContext& context, const Runner::Post&) -> Runner::Deliver {
    const auto report = html_report(*result, discovery.get(), context, frames);
    if (context.stopped()) return {};
    if (!report) return [this, error = report.error()] { Q_EMIT failed(error); };
    if (const Status s = write_file_atomically(path.toStdString(), report->html); !s)
      return [this, error = s.error()] { Q_EMIT failed(error); };
    QStringList warnings;
    for (const Message& warning : report->warnings) warnings.push_back(core_text(warning));
    return [this, path, warnings] { Q_EMIT written(path, warnings); };
  });
}

}  // namespace lvcalib::widgets

#include "moc_report_writer.cpp"
