@echo off
rem Clips that are dropped on this file: a folder each, beside the clip.
:next
if "%~1"=="" goto done
"%~dp0genga.exe" run "%~1" --out "%~dpn1-genga"
shift /1
goto next
:done
pause
