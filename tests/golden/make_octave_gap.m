% SPDX-License-Identifier: MIT
% Makes gap_octave.csv and follow_octave.csv: called with the folder that they go to in GOLDEN, from the
% top folder:  GOLDEN=tests/golden octave-cli --no-gui --quiet tests/golden/make_octave_gap.m
% The toolkit's centroid is trapz(x.*mu)/trapz(mu); we take its aggregated set, and MATLAB's sum(x.*mu)/sum(mu).
% Points of follow keep off the thresholds, where a last binary digit decides.
1;
warning ("off", "all");  # the toolkit uses operators that Octave 7 wants replaced
pkg load fuzzy-logic-toolkit;
version = pkg ("list", "fuzzy-logic-toolkit"){1}.version;
how = sprintf ("# made by tests/golden/make_octave_gap.m with Octave %s, fuzzy-logic-toolkit %s", OCTAVE_VERSION, version);

fid = fopen (fullfile (getenv ("GOLDEN"), "gap_octave.csv"), "w");
fprintf (fid, "%s\n# room,opening,accel_mps2 of tables/gap.fis\n", how);
fis = readfis ("tables/gap.fis");
x = linspace (-8, 8, 101)';
for room = -2 : 0.375 : 4
  for opening = -0.8 : 0.1 : 0.8
    [~, ~, ~, mu] = evalfis ([room opening], fis, 101);
    fprintf (fid, "%.13g,%.13g,%.13g\n", room, opening, sum (x .* mu) / sum (mu));
  endfor
endfor
fclose (fid);

fid = fopen (fullfile (getenv ("GOLDEN"), "follow_octave.csv"), "w");
fprintf (fid, "%s\n# file,gap_m,closing_mps,to_change_m,command,change\n", how);
for name = {"follow", "follow_paper"}
  fis = readfis (["tables/" name{1} ".fis"]);
  for gap = [0.31 : 0.43 : 9.9, 0.957, 1.013, 1.063]
    for closing = -1.93 : 0.31 : 1.93
      above = max (-1, min (1, gap - 1));
      y = evalfis ([gap closing above], fis, 101);
      fprintf (fid, "%s,%.13g,%.13g,%.13g,%.13g,%.13g\n", name{1}, gap, closing, above, round (y(1) * 2) / 2 + 0, ...
               round (y(2) * 2) / 2 + 0);
    endfor
  endfor
endfor
fclose (fid);
