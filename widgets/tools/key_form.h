// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QString>
#include <QStringList>
#include <QWidget>
#include <map>
#include <vector>

#include "base/error.h"

class QComboBox;
class QGridLayout;
class QLabel;
class QLineEdit;

namespace lvcalib::widgets {

/// One key of a small YAML file and how it is edited.
struct FormKey {
  enum class Kind { kNumber, kWord, kFlag };
  const char* name = "";
  Kind kind = Kind::kNumber;
  /// Shown value = value in the file · factor.
  double factor = 1.0;
  const char* unit = "";
  /// Words to choose from; another can be typed.
  QStringList words;
  /// A second field for the standard deviation, in the same unit.
  bool sigma = false;
};

/// Fields for the keys of a small YAML file: label, value, unit, and beside each the message of
/// whoever checked it. Values go in and out as the file has them; a field that is blank is a key
/// that the file lacks.
class KeyForm : public QWidget {
  Q_OBJECT

 public:
  explicit KeyForm(QWidget* parent = nullptr);

  void add(const FormKey& key);
  void setLabel(const QString& key, const QString& label, const QString& tip);
  /// Only these keys, all others are hidden.
  void showKeys(const QStringList& keys);

  void setValue(const QString& key, const QString& value);
  void setSigma(const QString& key, const QString& value);
  /// As a YAML scalar; empty: blank. Words that are no number stand in quotes where one is asked.
  [[nodiscard]] QString value(const QString& key) const;
  [[nodiscard]] QString sigma(const QString& key) const;
  /// Fields in view whose text is no number, each with a complaint; empty: none.
  [[nodiscard]] QStringList notNumbers() const;

  void clearComplaints();
  void complain(const QString& key, const QString& text);
  /// The key in view that an error names; empty: none.
  [[nodiscard]] QString keyNamedIn(const Error& error) const;
  [[nodiscard]] QString complaint(const QString& key) const;

 Q_SIGNALS:
  void edited();

 private:
  struct Row {
    FormKey key;
    QLabel* label = nullptr;
    QWidget* editor = nullptr;
    QLabel* unit = nullptr;
    QLabel* plus_minus = nullptr;
    QLineEdit* sigma = nullptr;
    QLabel* complaint = nullptr;
    bool in_view = true;
  };
  [[nodiscard]] static QString read(const Row& row, const QString& shown);
  [[nodiscard]] static QString shown(const Row& row, const QString& value);
  [[nodiscard]] static QString typed(const Row& row);
  [[nodiscard]] const Row& row(const QString& key) const;

  QGridLayout* layout_;
  std::vector<Row> rows_;
};

/// A form with what it describes beside it, which follows the room that there is.
struct FormParts {
  QLabel* choice_label;  ///< Of `choice`, whose value decides which keys there are.
  QComboBox* choice;
  KeyForm* form;
  QLabel* problem;   ///< Below the form: what is wrong with it as a whole.
  QWidget* picture;  ///< Of what the form describes.
  QLabel* note;      ///< Below the picture.
};
/// Lays all of `whole` out.
void lay_out_form(const FormParts& parts, QWidget& whole);

}  // namespace lvcalib::widgets
