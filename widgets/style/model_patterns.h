// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QtGlobal>

namespace lvcalib::widgets {

/// Like kCorePatterns: the core library's sentences about effects and the model.
inline constexpr const char* kModelPatterns[] = {
    // What a model with effects leaves.
    QT_TRANSLATE_NOOP("Core",
                      "ranges miss the model by %1 times their noise: another effect is missing in "
                      "the model"),
    QT_TRANSLATE_NOOP(
        "Core",
        "the %1 channel shows structure over %2 that no effect of the model explains; "
        "it could move the extrinsic by %3 mm and %4 mrad"),
    // Why the page suggests an effect, or what it knows of one.
    QT_TRANSLATE_NOOP("Core",
                      "%1 Found: %2. With it, scenes held out have %3 % less squared error in the "
                      "%4 channel and the extrinsic moves by %5 mm and %6 mrad. These scenes "
                      "cannot tell it from %7; to tell: %8."),
    QT_TRANSLATE_NOOP("Core",
                      "%1 Found: %2. With it, scenes held out have %3 % less squared error in the "
                      "%4 channel and the extrinsic moves by %5 mm and %6 mrad."),
    QT_TRANSLATE_NOOP("Core",
                      "%1 Found: %2; %3 = %4; leaving it out would move the extrinsic by %5 mm and "
                      "%6 mrad. These scenes cannot tell it from %7; to tell: %8."),
    QT_TRANSLATE_NOOP("Core",
                      "%1 Found: %2; %3 = %4; leaving it out would move the extrinsic by %5 mm and "
                      "%6 mrad."),
    QT_TRANSLATE_NOOP("Core",
                      "%1 Found: %2; leaving it out would move the extrinsic by %3 mm and %4 mrad. "
                      "These scenes cannot tell it from %5; to tell: %6."),
    QT_TRANSLATE_NOOP(
        "Core", "%1 Found: %2; leaving it out would move the extrinsic by %3 mm and %4 mrad."),
    QT_TRANSLATE_NOOP("Core", "it runs from %1 to %2 over %3, known to %4"),
    QT_TRANSLATE_NOOP("Core", "period (m)"),
    QT_TRANSLATE_NOOP("Core", "decay length (m)"),
    QT_TRANSLATE_NOOP("Core", "exponent (2 more: power by range and incidence)"),
    QT_TRANSLATE_NOOP("Core", "decay (share of the session)"),
    QT_TRANSLATE_NOOP("Core", "decay (s)"),
    QT_TRANSLATE_NOOP("Core", "width s (rad)"),
    QT_TRANSLATE_NOOP("Core", "%1 In the model, held: %2."),
    QT_TRANSLATE_NOOP("Core", "%1 In the model: %2."),
    QT_TRANSLATE_NOOP("Core",
                      "Explains the same as %1, which is in the model: these scenes cannot tell "
                      "the two apart. To tell: %2."),
    QT_TRANSLATE_NOOP(
        "Core",
        "Not there as far as it matters: %1; it moves the extrinsic by %2 mm and %3 mrad at most."),
    QT_TRANSLATE_NOOP(
        "Core", "Too small to matter: %1; it moves the extrinsic by %2 mm and %3 mrad at most."),
    QT_TRANSLATE_NOOP("Core",
                      "White and black print contradict each other about it: %1 of both together; "
                      "something that depends on the print is at work."),
    QT_TRANSLATE_NOOP("Core",
                      "White and black return unlike shares of light as range and incidence "
                      "change, which no effect explains; edges are found in these intensities and "
                      "cannot tell: %1."),
    QT_TRANSLATE_NOOP("Core",
                      "It explains %1 % of what is wrong in the %2 channel: %3; something else is "
                      "at work there."),
    QT_TRANSLATE_NOOP("Core",
                      "Where it fits best it predicts scenes held out worse: %1; too few of them "
                      "show it. To decide: %2."),
    QT_TRANSLATE_NOOP("Core",
                      "What fits best is impossible: %1, while no device has less than %2; "
                      "something else is at work."),
    QT_TRANSLATE_NOOP(
        "Core",
        "Cannot be told from these scenes: %1; it may move the extrinsic by %2 mm and %3 mrad. To "
        "see it: %4."),
    QT_TRANSLATE_NOOP("Core",
                      "Undecided: %1 is neither excluded nor confirmed by scenes held out; it may "
                      "move the extrinsic by %2 mm and %3 mrad. To decide: %4."),
    QT_TRANSLATE_NOOP("Core", "Not testable: %1."),
    // Why an effect cannot be tested or used.
    QT_TRANSLATE_NOOP("Core", "no time in these clouds"),
    QT_TRANSLATE_NOOP("Core", "no laser lines in these clouds"),
    QT_TRANSLATE_NOOP("Core", "no intensity in these clouds (or the same on all points)"),
    QT_TRANSLATE_NOOP("Core", "no edges of the print in the returns"),
    QT_TRANSLATE_NOOP("Core", "measured with the base model, as the beam's blur"),
    QT_TRANSLATE_NOOP("Core", "no tags on this board"),
    QT_TRANSLATE_NOOP(
        "Core",
        "not defined: the same as a turn of the LiDAR frame, which is part of the extrinsic"),
    QT_TRANSLATE_NOOP("Core", "the effect '%1' cannot be used: %2"),
    QT_TRANSLATE_NOOP("Core", "the effect '%1' is in the model already"),
    QT_TRANSLATE_NOOP("Core", "there is no effect '%1'; did you mean '%2'?"),
    QT_TRANSLATE_NOOP("Core", "there is no effect '%1'"),
    QT_TRANSLATE_NOOP(
        "Core",
        "not enough scenes to look for effects: %1, three or more are needed to hold one out"),
    QT_TRANSLATE_NOOP("Core",
                      "the joint solve over every return failed: nothing to look for effects with"),
    QT_TRANSLATE_NOOP("Core", "see the warnings of the calibration"),
    QT_TRANSLATE_NOOP("Core",
                      "take scenes at other distances and with the board turned differently"),
    // Formulas and curves.
    QT_TRANSLATE_NOOP("Core",
                      "in '%1': there is no channel '%2'; did you mean '%3'? (expected corner, "
                      "range, boundary or intensity)"),
    QT_TRANSLATE_NOOP(
        "Core",
        "in '%1': there is no channel '%2' (expected corner, range, boundary or intensity)"),
    QT_TRANSLATE_NOOP("Core", "in '%1': there is no covariate '%2'; did you mean '%3'?"),
    QT_TRANSLATE_NOOP("Core", "in '%1': there is no covariate '%2'"),
    QT_TRANSLATE_NOOP("Core", "in '%1': expected '[low..high]' or '[1|2|3]' after %2, found '%3'"),
    QT_TRANSLATE_NOOP("Core", "'%1' has %2 covariates, expected one or two"),
    QT_TRANSLATE_NOOP("Core", "'%1' names the same covariate twice"),
    QT_TRANSLATE_NOOP("Core", "'%1': %2 is a label; a curve over two covariates needs two scales"),
    QT_TRANSLATE_NOOP("Core", "'%1' is not complete, expected '%2', such as '%3'"),
    QT_TRANSLATE_NOOP("Core",
                      "in the formula '%1' at character %2: '=' assigns; expected an expression "
                      "(write == to compare)"),
    QT_TRANSLATE_NOOP("Core", "in the formula '%1' at character %2: %3"),
    QT_TRANSLATE_NOOP("Core",
                      "in the formula '%1': there is no covariate '%2'; did you mean '%3'?"),
    QT_TRANSLATE_NOOP("Core", "in the formula '%1': there is no covariate '%2'"),
    QT_TRANSLATE_NOOP("Core", "in the formula '%1': %2"),
    QT_TRANSLATE_NOOP("Core", "coefficients are single letters; this channel has %1"),
    QT_TRANSLATE_NOOP(
        "Core",
        "the formula '%1' has no free coefficient; expected one or more, such as a in 'a*range'"),
    QT_TRANSLATE_NOOP("Core", "the formula '%1' has %2 values separated by commas, expected one"),
    QT_TRANSLATE_NOOP("Core", "the formula has %1 characters, expected at most %2"),
    // Progress of the search.
    QT_TRANSLATE_NOOP("Core", "fitting the model"),
    QT_TRANSLATE_NOOP("Core", "looking for structure"),
    QT_TRANSLATE_NOOP("Core", "ranking effects, %1 in the model"),
    QT_TRANSLATE_NOOP("Core", "ranking effects"),
    QT_TRANSLATE_NOOP("Core", "judging effects"),
    QT_TRANSLATE_NOOP("Core", "collecting measurements"),
    QT_TRANSLATE_NOOP("Core", "looking for the next scene"),
    // Channels.
    QT_TRANSLATE_NOOP("Core", "corner"),
    QT_TRANSLATE_NOOP("Core", "range"),
    QT_TRANSLATE_NOOP("Core", "boundary"),
    QT_TRANSLATE_NOOP("Core", "intensity"),
};

}  // namespace lvcalib::widgets
