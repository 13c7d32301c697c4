// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QtGlobal>

namespace lvcalib::widgets {

/// The core library's sentences that a user of the window meets, with %1, %2 … for what is filled
/// in; the first that fits counts, so that special ones stand before general ones. Texts that the
/// core declares in lists (options, formats) are not here: packaging/update-translations.sh reads
/// them from the core itself.
inline constexpr const char* kCorePatterns[] = {
    // Verdict and warnings of a result.
    QT_TRANSLATE_NOOP("Core", "result: %1"),
    QT_TRANSLATE_NOOP("Core", "scene %1 is not used: %2"),
    QT_TRANSLATE_NOOP("Core",
                      "without scene %1 the extrinsic moves by %2 mm and %3 mrad, more than three "
                      "of its standard deviations: did something move while that scene was taken?"),
    QT_TRANSLATE_NOOP("Core",
                      "the board moves against the LiDAR while it scans, in all scenes alike, by "
                      "%1 mm/s; with that the extrinsic moves by %2 mm and %3 mrad; let board and "
                      "rig rest, or find the effect with lvcalib discover"),
    QT_TRANSLATE_NOOP("Core",
                      "the board moves against the LiDAR while it scans, in scene %1, by %2 mm/s; "
                      "with that the extrinsic moves by %3 mm and %4 mrad; let board and rig rest, "
                      "or find the effect with lvcalib discover"),
    QT_TRANSLATE_NOOP("Core",
                      "the print lies displaced along the scan, by %1 µs of it; with that the "
                      "extrinsic moves by %2 mm and %3 mrad: intensity or angle is read too late; "
                      "find the effect with lvcalib discover"),
    QT_TRANSLATE_NOOP(
        "Core",
        "the LiDAR's angles do not fit the boards (scale, eccentric encoder or tilted "
        "axis); with that the extrinsic moves by %1 mm and %2 mrad: find the effect "
        "with lvcalib discover"),
    QT_TRANSLATE_NOOP("Core",
                      "the LiDAR's beams start beside the origin of its frame, by %1 mm; with that "
                      "the extrinsic moves by %2 mm and %3 mrad: find the effect with lvcalib "
                      "discover"),
    QT_TRANSLATE_NOOP("Core",
                      "the clouds' coordinates are rounded to steps of %1 mm, which may displace "
                      "edges of the print by %2 mm: scene %3; write them to the millimetre"),
    QT_TRANSLATE_NOOP("Core",
                      "the images contradict the standard deviations of the intrinsics: %1; "
                      "calibrate the camera again, or use --intrinsics free"),
    QT_TRANSLATE_NOOP(
        "Core",
        "the images contradict the intrinsics: %1; with that freed the extrinsic moves by %2 mm "
        "and %3 mrad; calibrate the camera again, or use --intrinsics free"),
    QT_TRANSLATE_NOOP("Core",
                      "the images contradict the intrinsics: %1; with that freed the extrinsic "
                      "moves by %2 mm and %3 mrad, less than what matters"),
    QT_TRANSLATE_NOOP("Core",
                      "the images contradict the intrinsics: %1; calibrate the camera again, or "
                      "use --intrinsics free"),
    QT_TRANSLATE_NOOP("Core", "the images contradict the intrinsics: %1, less than what matters"),
    QT_TRANSLATE_NOOP("Core", "the images contradict the intrinsics: %1"),
    QT_TRANSLATE_NOOP("Core",
                      "the circles' centres miss the model by more than their radius: the clouds "
                      "do not show them"),
    QT_TRANSLATE_NOOP(
        "Core",
        "these scenes cannot verify the camera's intrinsics; most open is the %1 would tell"),
    QT_TRANSLATE_NOOP(
        "Core",
        "focal length: a scene with the board tilted by 40° or more and one at twice the distance"),
    QT_TRANSLATE_NOOP(
        "Core",
        "principal point: scenes with the board tilted, and rolled by 90° against each other"),
    QT_TRANSLATE_NOOP("Core", "distortion: scenes with the board in the corners of the image"),
    QT_TRANSLATE_NOOP("Core", "the same files as scene %1, which counts once"),
    QT_TRANSLATE_NOOP(
        "Core",
        "its image and that of scene %1 seem to be exchanged: the scenes agree if they are"),
    QT_TRANSLATE_NOOP(
        "Core",
        "the rough extrinsic (rig.yaml or --init) contradicts the scenes and was left out: %1"),
    QT_TRANSLATE_NOOP("Core",
                      "the board is not found in any cloud, but it is if the clouds are %1"),
    QT_TRANSLATE_NOOP(
        "Core", "only one usable scene: nothing to check the result against; take two or more"),
    QT_TRANSLATE_NOOP(
        "Core", "only one usable scene: nothing to check the result against; take two or more; %1"),
    QT_TRANSLATE_NOOP(
        "Core", "scene %1 has the same image as scene %2: one of the two is not the scene's own"),
    QT_TRANSLATE_NOOP(
        "Core", "scene %1 has the same cloud as scene %2: one of the two is not the scene's own"),
    QT_TRANSLATE_NOOP("Core",
                      "%1 t = [%2] m, %3 t = [%4] m, %5 mm and %6 mrad apart: did a sensor move "
                      "between scenes %7 and %8?"),
    QT_TRANSLATE_NOOP(
        "Core",
        "scene %1 contradicts the others, which agree: it puts the LiDAR %2 mm and %3 "
        "mrad elsewhere; did the board or a sensor move while it was taken?"),
    QT_TRANSLATE_NOOP("Core",
                      "the extrinsic moves steadily from scene to scene, by %1 mm and %2 mrad from "
                      "the first to the last: does a mount give way?"),
    QT_TRANSLATE_NOOP("Core",
                      "the clouds or the images of scenes %1 and %2 seem to be exchanged: all "
                      "scenes agree if they are"),
    QT_TRANSLATE_NOOP("Core", "scenes %1 give"),
    QT_TRANSLATE_NOOP("Core", "scene %1 gives"),
    QT_TRANSLATE_NOOP(
        "Core", "no image shows the tags of the right columns that target.yaml has: %1 would fit"),
    QT_TRANSLATE_NOOP(
        "Core", "no image shows the tags of the upper rows that target.yaml has: %1 would fit"),
    QT_TRANSLATE_NOOP("Core",
                      "the images contradict target.yaml: %1 would fit (corners then scatter by %2 "
                      "px, now by %3 px); measure the print"),
    QT_TRANSLATE_NOOP("Core",
                      "the images contradict target.yaml: %1 would fit (corners then scatter by %2 "
                      "px, now by %3 px)"),
    QT_TRANSLATE_NOOP("Core", "the tags do not lie where the target has them; they do with %1"),
    QT_TRANSLATE_NOOP("Core",
                      "the image shows tags %1 of %2; the target has %3; all of them fit with %4"),
    QT_TRANSLATE_NOOP("Core", "the scenes determine only %1 of 6 directions of the extrinsic"),
    QT_TRANSLATE_NOOP("Core",
                      "the scenes leave the extrinsic open: ± %1 mm and ± %2 mrad along the worst "
                      "axes; add scenes with the board turned differently"),
    QT_TRANSLATE_NOOP("Core",
                      "LiDAR and camera disagree on the board's size: the LiDAR measures it %1 % "
                      "larger than target.yaml says; measure the print and correct tagSize"),
    QT_TRANSLATE_NOOP("Core",
                      "LiDAR and camera disagree on the board's size: the LiDAR measures it %1 % "
                      "smaller than target.yaml says; measure the print and correct tagSize"),
    QT_TRANSLATE_NOOP("Core",
                      "black print reads %1 mm farther than white: the LiDAR's range depends on "
                      "the reflectivity, an effect is missing in the model"),
    QT_TRANSLATE_NOOP("Core",
                      "black print reads %1 mm nearer than white: the LiDAR's range depends on "
                      "the reflectivity, an effect is missing in the model"),
    QT_TRANSLATE_NOOP("Core",
                      "scene %1: its board measures %2 % larger than in the other scenes: is it "
                      "another print?"),
    QT_TRANSLATE_NOOP("Core",
                      "scene %1: its board measures %2 % smaller than in the other scenes: is it "
                      "another print?"),
    QT_TRANSLATE_NOOP("Core",
                      "the halves of the scenes (%1) differ by %2 mm and %3 mrad, more than noise "
                      "explains (χ² %4, at most %5): an effect is missing in the model, or one "
                      "scene is off"),
    QT_TRANSLATE_NOOP("Core",
                      "the joint solve puts the LiDAR %1 mm and %2 mrad from where the localized "
                      "boards put it, more than both leave open: it may have locked onto another "
                      "place of the print; add scenes with the board turned differently"),
    QT_TRANSLATE_NOOP(
        "Core", "two scenes: a mistake in one of them could not be told from one in the other"),
    QT_TRANSLATE_NOOP("Core",
                      "tag corners miss their model by %1 px: check the intrinsics and that the "
                      "board is flat"),
    QT_TRANSLATE_NOOP("Core",
                      "LiDAR residuals are %1 times (nodes) and %2 times (planes) their noise: an "
                      "effect is missing in the model; scene %3 misses most: %4 mm, the others "
                      "%5 mm"),
    QT_TRANSLATE_NOOP("Core",
                      "LiDAR residuals are %1 times (nodes) and %2 times (planes) their noise: an "
                      "effect is missing in the model"),
    QT_TRANSLATE_NOOP("Core", "another assignment of the board is nearly as good (margin %1)"),
    QT_TRANSLATE_NOOP("Core",
                      "the model of every return could not be solved (%1): the extrinsic rests on "
                      "nodes, planes and corners"),
    QT_TRANSLATE_NOOP(
        "Core",
        "the clouds' intensity is missing or the same everywhere: the extrinsic rests "
        "on planes and corners, and the print does not hold it sideways"),
    QT_TRANSLATE_NOOP("Core",
                      "the print has no contrast for this LiDAR: the extrinsic rests on planes and "
                      "corners, and the print does not hold it sideways"),
    QT_TRANSLATE_NOOP("Core",
                      "the clouds' intensities do not follow the target's print: the extrinsic "
                      "rests on planes and corners, and the print does not hold it sideways; does "
                      "target.yaml describe this board?"),
    QT_TRANSLATE_NOOP(
        "Core",
        "%1 in scene %2: planes and corners are used there; does target.yaml describe this board?"),
    QT_TRANSLATE_NOOP("Core", "%1 in scene %2: planes and corners are used there"),
    QT_TRANSLATE_NOOP("Core", "the clouds' intensity is missing or the same everywhere"),
    QT_TRANSLATE_NOOP("Core", "the print has no contrast for this LiDAR"),
    QT_TRANSLATE_NOOP("Core", "the clouds' intensities do not follow the target's print"),
    QT_TRANSLATE_NOOP(
        "Core", "the LiDAR sees %1 % of the board only: something covers it, or it is cut off"),
    QT_TRANSLATE_NOOP("Core", "the board is not found in the cloud, which holds %1 points only"),
    QT_TRANSLATE_NOOP("Core",
                      "the clouds hold a second board with this print: another extrinsic has %1 % "
                      "of the evidence of this one; take one of the boards away, or give a rough "
                      "extrinsic with --init"),
    QT_TRANSLATE_NOOP("Core",
                      "white print is saturated, so that the place of its edges is not measured: "
                      "scene %1; lower the LiDAR's gain or print the white greyer"),
    QT_TRANSLATE_NOOP("Core",
                      "the intensities are saturated on part of the board: scene %1; lower the "
                      "LiDAR's gain or print the white greyer"),
    QT_TRANSLATE_NOOP("Core",
                      "ambiguous: another place of the print on the board fits the intensities of "
                      "all scenes nearly as well (log-likelihood %1 less)"),
    QT_TRANSLATE_NOOP("Core",
                      "LiDAR and camera disagree on the board's size: the LiDAR sees the print %1 "
                      "% larger than target.yaml says; %2 would fit; measure the print"),
    QT_TRANSLATE_NOOP("Core",
                      "LiDAR and camera disagree on the board's size: the LiDAR sees the print %1 "
                      "% smaller than target.yaml says; %2 would fit; measure the print"),
    QT_TRANSLATE_NOOP(
        "Core",
        "LiDAR and camera disagree on the board's size: the LiDAR sees the print %1 % as wide and "
        "%2 % as high as target.yaml says; %3 would fit; measure the print"),
    // Weak directions.
    QT_TRANSLATE_NOOP("Core", "%1 is not determined: add scenes with the board turned differently"),
    QT_TRANSLATE_NOOP("Core", "%1 is known %2 times worse than the typical direction: %3"),
    QT_TRANSLATE_NOOP("Core", "translation along the camera's x axis"),
    QT_TRANSLATE_NOOP("Core", "translation along the camera's y axis"),
    QT_TRANSLATE_NOOP("Core", "translation along the camera's z axis"),
    QT_TRANSLATE_NOOP("Core", "rotation about the camera's x axis"),
    QT_TRANSLATE_NOOP("Core", "rotation about the camera's y axis"),
    QT_TRANSLATE_NOOP("Core", "rotation about the camera's z axis"),
    QT_TRANSLATE_NOOP("Core",
                      "add a scene much nearer or farther, to part it from the turn about y"),
    QT_TRANSLATE_NOOP("Core",
                      "add a scene much nearer or farther, to part it from the turn about x"),
    QT_TRANSLATE_NOOP("Core", "add a scene with the board nearer and tilted"),
    QT_TRANSLATE_NOOP("Core", "add a scene much nearer or farther, or high or low in the image"),
    QT_TRANSLATE_NOOP("Core",
                      "add a scene much nearer or farther, or far left or right in the image"),
    QT_TRANSLATE_NOOP("Core", "add a scene with the board near the image's edge"),
    // Why a scene is not used.
    QT_TRANSLATE_NOOP("Core", "rejected by the user"),
    QT_TRANSLATE_NOOP("Core", "not used"),
    QT_TRANSLATE_NOOP("Core", "the board found in the cloud does not agree with the other scenes"),
    QT_TRANSLATE_NOOP("Core",
                      "the board is not found in the cloud (%1); the LiDAR sees past the place "
                      "where the image has it: does the image belong to this cloud?"),
    QT_TRANSLATE_NOOP("Core",
                      "the board is not found in the cloud (%1); something nearer stands where the "
                      "image has it: does the image belong to this cloud, or is the board hidden "
                      "from the LiDAR?"),
    QT_TRANSLATE_NOOP("Core", "the board is not found in the cloud (%1)"),
    QT_TRANSLATE_NOOP("Core", "not searched"),
    QT_TRANSLATE_NOOP("Core", "%1 flat patches of its size, best pattern correlation %2"),
    QT_TRANSLATE_NOOP("Core", "%1 flat patches of its size"),
    QT_TRANSLATE_NOOP("Core", "the crop box holds no points"),
    QT_TRANSLATE_NOOP("Core",
                      "contradicts the other scenes by %1 mm and %2 mrad: did the board or the rig "
                      "move between cloud and image?"),
    QT_TRANSLATE_NOOP("Core", "refinement did not settle within its iterations"),
    QT_TRANSLATE_NOOP("Core", "only %1 of %2 circles usable; node %3: %4"),
    QT_TRANSLATE_NOOP("Core", "only %1 of %2 circles usable"),
    QT_TRANSLATE_NOOP(
        "Core",
        "no tags in the image (the board must be in view, sharp, and neither dark nor "
        "overexposed)"),
    QT_TRANSLATE_NOOP("Core",
                      "its checkerboard has black and white squares the other way round than in "
                      "most scenes: is it another board, or is the image mirrored?"),
    QT_TRANSLATE_NOOP("Core",
                      "the board, or one with the same tags, is in the image twice (cover one of "
                      "them, or leave this scene out)"),
    QT_TRANSLATE_NOOP("Core",
                      "two checkerboards of this size are in the image (cover one of them, or "
                      "leave this scene out)"),
    // Bins and nodes of the refinement.
    QT_TRANSLATE_NOOP("Core", "used"),
    QT_TRANSLATE_NOOP("Core", "too few samples"),
    QT_TRANSLATE_NOOP("Core", "contrast too weak for the noise"),
    QT_TRANSLATE_NOOP("Core", "samples on one side of the edge only"),
    QT_TRANSLATE_NOOP("Core", "no crossing of the mid-level"),
    QT_TRANSLATE_NOOP("Core", "contradicts the other bins"),
    QT_TRANSLATE_NOOP("Core",
                      "too few samples: %1 inside and %2 outside the circle, at least %3 each "
                      "needed"),
    QT_TRANSLATE_NOOP("Core", "no contrast between circle and paper"),
    QT_TRANSLATE_NOOP("Core", "too few usable bins around the circle"),
    QT_TRANSLATE_NOOP("Core", "centre too uncertain"),
    // Boundary response.
    QT_TRANSLATE_NOOP("Core", "not refined"),
    QT_TRANSLATE_NOOP("Core", "not enough samples"),
    QT_TRANSLATE_NOOP("Core", "no contrast"),
    QT_TRANSLATE_NOOP("Core", "intensity clipped"),
    QT_TRANSLATE_NOOP("Core", "not refined: %1"),
    QT_TRANSLATE_NOOP("Core", "not enough samples: %1"),
    QT_TRANSLATE_NOOP("Core", "no contrast: %1"),
    QT_TRANSLATE_NOOP("Core",
                      "%1 in the overlap region, %2 on the circle, %3 on the paper; needed %4, %5 "
                      "and %6"),
    QT_TRANSLATE_NOOP("Core", "black %1, white %2, noise %3"),
    QT_TRANSLATE_NOOP("Core", "intensity clipped: %1 of the paper's samples at the highest value"),
    QT_TRANSLATE_NOOP("Core", "intensity clipped: %1 of the circle's samples at the highest value"),
    QT_TRANSLATE_NOOP("Core", "intensity clipped: %1 of the paper's samples at the lowest value"),
    QT_TRANSLATE_NOOP("Core", "intensity clipped: %1 of the circle's samples at the lowest value"),
    QT_TRANSLATE_NOOP("Core", "the cloud has no intensity"),
    QT_TRANSLATE_NOOP("Core",
                      "the intensities about the circles show no transition from black to white"),
    QT_TRANSLATE_NOOP("Core", "the transitions about the circles have no common width"),
    QT_TRANSLATE_NOOP("Core",
                      "not enough samples for statistics: %1 in the overlap region, needed %2 "
                      "around the circles"),
    QT_TRANSLATE_NOOP("Core", "no circle gives boundary samples: %1 (the first: %2)"),
    QT_TRANSLATE_NOOP("Core", "no circle gives boundary samples: %1"),
    QT_TRANSLATE_NOOP("Core", "%1 × %2, %3"),
    QT_TRANSLATE_NOOP("Core", "%1 × %2"),
    QT_TRANSLATE_NOOP("Core", "this board has no circles"),
    QT_TRANSLATE_NOOP("Core", "not enough scenes for a boundary response: none is in use"),
    // Halves of the scenes.
    QT_TRANSLATE_NOOP("Core",
                      "not enough scenes for a comparison of halves: neither half alone determines "
                      "the extrinsic"),
    QT_TRANSLATE_NOOP("Core", "not enough scenes for a comparison of halves: %1 in use, %2 needed"),
    QT_TRANSLATE_NOOP("Core", "near/far"),
    QT_TRANSLATE_NOOP("Core", "left/right"),
    QT_TRANSLATE_NOOP("Core", "flat/tilted"),
    // Progress.
    QT_TRANSLATE_NOOP("Core", "joint solve"),
    QT_TRANSLATE_NOOP("Core", "comparing scenes"),
    QT_TRANSLATE_NOOP("Core", "other sizes of the board"),
    QT_TRANSLATE_NOOP("Core", "done"),
    QT_TRANSLATE_NOOP("Core", "scene %1"),
    // What is left out, and files that cannot be used.
    QT_TRANSLATE_NOOP("Core", "scene %1 is used all the same, as you decided, though %2"),
    QT_TRANSLATE_NOOP("Core", "scenes held out speak for an effect that the model lacks: %1"),
    QT_TRANSLATE_NOOP("Core", "structure is left that no known effect explains"),
    QT_TRANSLATE_NOOP("Core", "misses the board's pose by %1 mm, more than the gate"),
    QT_TRANSLATE_NOOP("Core", "misses the board's pose by more than the gate"),
    QT_TRANSLATE_NOOP("Core", "off the board's plane"),
    QT_TRANSLATE_NOOP("Core", "something stands before the board there or lies on it"),
    QT_TRANSLATE_NOOP("Core", "%1: the image file is empty"),
    QT_TRANSLATE_NOOP("Core", "%1: the image cannot be decoded: its data are damaged (%2)"),
    QT_TRANSLATE_NOOP(
        "Core",
        "%1: is truncated: its header says %2 points, found %3 (copy or export the file again)"),
    QT_TRANSLATE_NOOP("Core", "%1: file not found"),
    QT_TRANSLATE_NOOP("Core", "no scene can be used; scene %1: %2"),
    QT_TRANSLATE_NOOP(
        "Core",
        "this folder is no dataset; a dataset holds target.yaml (the board), camera.yaml (the "
        "intrinsics) and scenes/NAME/ with image.png and cloud.pcd for every scene"),
    QT_TRANSLATE_NOOP("Core", "choose the folder that holds these, or make one from a recording"),
    QT_TRANSLATE_NOOP("Core",
                      "%1: no image in this scene; expected image.png, .jpg, .bmp or .tiff"),
    QT_TRANSLATE_NOOP("Core", "%1: no cloud in this scene; expected cloud.pcd or cloud.ply"),
    QT_TRANSLATE_NOOP("Core", "the result names no image of a scene in use"),
    QT_TRANSLATE_NOOP("Core", "the result names no image and cloud of a scene in use"),
    QT_TRANSLATE_NOOP("Core", "calibrate again with this version"),
    QT_TRANSLATE_NOOP("Core", "is of another size than the camera's images"),
    QT_TRANSLATE_NOOP(
        "Core",
        "'%1' is no name of a frame; expected letters, digits and _ - . /, not beginning with - "
        "and without --"),
    QT_TRANSLATE_NOOP("Core", "as the robot's description calls it: velodyne, camera_left"),
    QT_TRANSLATE_NOOP("Core",
                      "holds no extrinsic; expected T_camera_lidar (a result) or T_CL (a truth)"),
    QT_TRANSLATE_NOOP("Core", "give the result.json of a calibration"),
    QT_TRANSLATE_NOOP("Core", "left out by the user"),
    QT_TRANSLATE_NOOP("Core", "too few tags: the others are left out by the user"),
    QT_TRANSLATE_NOOP("Core", "there is no calibration yet"),
    // Plans of scenes.
    QT_TRANSLATE_NOOP("Core", "predicting measurements"),
    QT_TRANSLATE_NOOP("Core", "choosing scene %1"),
    QT_TRANSLATE_NOOP("Core", "the grid has no more poses than %1"),
    QT_TRANSLATE_NOOP("Core", "so few scenes do not determine the extrinsic"),
    QT_TRANSLATE_NOOP("Core",
                      "%1 stays hard to test: what matters of it stands %2 σ above zero; to see "
                      "it: %3"),
    QT_TRANSLATE_NOOP("Core",
                      "no board pose of the grid is in view of both sensors (%1 are in view of the "
                      "camera)"),
    QT_TRANSLATE_NOOP("Core", "check the field of view and T_camera_lidar, or use a smaller board"),
    QT_TRANSLATE_NOOP("Core", "the effect '%1' cannot be planned for: %2"),
    QT_TRANSLATE_NOOP("Core", "the LiDAR's description says no time"),
    QT_TRANSLATE_NOOP("Core", "the LiDAR's description has one line only"),
    QT_TRANSLATE_NOOP("Core", "the LiDAR's description says no intensity"),
    QT_TRANSLATE_NOOP("Core", "this board has no tags"),
    QT_TRANSLATE_NOOP("Core",
                      "planning: what is known of the extrinsic before must be a covariance "
                      "without directions that are known exactly or not at all"),
    QT_TRANSLATE_NOOP("Core", "%1: expected %2, found '%3'"),
    QT_TRANSLATE_NOOP("Core", "%1: expected [low, high] in %2 to %3 degrees"),
    QT_TRANSLATE_NOOP("Core", "%1: its left 3x3 part is not a rotation"),
    // Folders that are watched.
    QT_TRANSLATE_NOOP("Core", "is still being written"),
    QT_TRANSLATE_NOOP("Core", "cannot be read yet: %1"),
    QT_TRANSLATE_NOOP("Core", "no cloud belongs to it"),
    QT_TRANSLATE_NOOP("Core", "no image belongs to it"),
    QT_TRANSLATE_NOOP("Core", "no image in this scene; expected image.png, .jpg, .bmp or .tiff"),
    QT_TRANSLATE_NOOP("Core", "no cloud in this scene; expected cloud.pcd or cloud.ply"),
    QT_TRANSLATE_NOOP("Core", "there is already a scene of this name"),
    QT_TRANSLATE_NOOP("Core", "folder not found"),
    QT_TRANSLATE_NOOP("Core", "cannot be listed: %1"),
    // Scenes named before anything else that is said of them.
    QT_TRANSLATE_NOOP("Core", "scene %1: %2"),
};

}  // namespace lvcalib::widgets
