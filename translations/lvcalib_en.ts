<?xml version="1.0" encoding="utf-8"?>
<!DOCTYPE TS>
<TS version="2.1" language="en">
<context>
    <name>EditsText</name>
    <message numerus="yes">
        <source>%n parts of the board</source>
        <translation>
            <numerusform>%n part of the board</numerusform>
            <numerusform>%n parts of the board</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>%n points</source>
        <translation>
            <numerusform>%n point</numerusform>
            <numerusform>%n points</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>lvcalib::widgets::CameraDialog</name>
    <message numerus="yes">
        <source>%n images.</source>
        <translation>
            <numerusform>%n image.</numerusform>
            <numerusform>%n images.</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>lvcalib::widgets::CheckDialog</name>
    <message numerus="yes">
        <source>%n pairs were left out; the first: %1</source>
        <translation>
            <numerusform>%n pair was left out: %1</numerusform>
            <numerusform>%n pairs were left out; the first: %1</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>lvcalib::widgets::CloudBrush</name>
    <message numerus="yes">
        <source>%n points</source>
        <translation>
            <numerusform>%n point</numerusform>
            <numerusform>%n points</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>lvcalib::widgets::CorrectDialog</name>
    <message numerus="yes">
        <source>%n clouds, %1 points, moved by %2 mm RMS, %3 mm at most.</source>
        <translation>
            <numerusform>%n cloud, %1 points, moved by %2 mm RMS, %3 mm at most.</numerusform>
            <numerusform>%n clouds, %1 points, moved by %2 mm RMS, %3 mm at most.</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>lvcalib::widgets::ResponsePage</name>
    <message numerus="yes">
        <source>Scene %1, %n points on the board:</source>
        <translation>
            <numerusform>Scene %1, %n point on the board:</numerusform>
            <numerusform>Scene %1, %n points on the board:</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>Scene %1, %n points at x %2 to %3 m, y %4 to %5 m on the board:</source>
        <translation>
            <numerusform>Scene %1, %n point at x %2 to %3 m, y %4 to %5 m on the board:</numerusform>
            <numerusform>Scene %1, %n points at x %2 to %3 m, y %4 to %5 m on the board:</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>lvcalib::widgets::ScenePage</name>
    <message numerus="yes">
        <source>Part of the board, %n points left out: %1</source>
        <translation>
            <numerusform>Part of the board, %n point left out: %1</numerusform>
            <numerusform>Part of the board, %n points left out: %1</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>%n points about the board</source>
        <translation>
            <numerusform>%n point about the board</numerusform>
            <numerusform>%n points about the board</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>%n measurements selected on the Model page</source>
        <translation>
            <numerusform>%n measurement selected on the Model page</numerusform>
            <numerusform>%n measurements selected on the Model page</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>Part of the board, %n points left out by hand</source>
        <translation>
            <numerusform>Part of the board, %n point left out by hand</numerusform>
            <numerusform>Part of the board, %n points left out by hand</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>lvcalib::widgets::ThresholdPane</name>
    <message numerus="yes">
        <source>%n more</source>
        <translation>
            <numerusform>%n more</numerusform>
            <numerusform>%n more</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>lvcalib::widgets::Workspace</name>
    <message numerus="yes">
        <source>Opened %1 with %n scenes.</source>
        <translation>
            <numerusform>Opened %1 with %n scene.</numerusform>
            <numerusform>Opened %1 with %n scenes.</numerusform>
        </translation>
    </message>
</context>
</TS>
