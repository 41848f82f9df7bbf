% SPDX-License-Identifier: MIT
% Makes the golden data that come from Octave's fuzzy-logic-toolkit; called by make_octave.sh, which says the
% folders: GOLDEN, where the systems are and the data go, and BUILD for files in between.
% The toolkit's own centroid is trapz(x.*mu)/trapz(mu) and its bisector gives an index, so of a Mamdani system
% we take the toolkit's aggregated set, and apply MATLAB's rules of defuzzification to that, one line each.
1;
warning ("off", "all");  # the toolkit uses operators that Octave 7 wants replaced
pkg load fuzzy-logic-toolkit;
golden = getenv ("GOLDEN");
build = getenv ("BUILD");
version = pkg ("list", "fuzzy-logic-toolkit"){1}.version;
how = sprintf ("# made by tests/golden/make_octave.sh with Octave %s, fuzzy-logic-toolkit %s", OCTAVE_VERSION, version);

function path = variant (source, target, varargin)
  text = fileread (source);
  for i = 1 : 2 : numel (varargin)
    text = regexprep (text, [varargin{i} "='[a-z_]*'"], [varargin{i} "='" varargin{i + 1} "'"]);
  endfor
  text = strrep (text, "'probor'", "'algebraic_sum'");             # its name in the toolkit
  text = strrep (text, "'trimf',[0 0 10]", "'trimf',[-10 0 10]");  # the toolkit wants a < b; same from 0 on
  fid = fopen (target, "w");
  fputs (fid, text);
  fclose (fid);
  path = target;
endfunction

% MATLAB's defuzz, on the samples that the toolkit gives.
function y = defuzz_all (x, mu)
  top = x(mu == max (mu));
  [~, small] = min (abs (top));
  [~, large] = max (abs (top));
  y = [sum(x .* mu) / sum(mu), x(find (cumsum (mu) >= sum (mu) / 2, 1)), mean(top), top(small), top(large)];
endfunction

function put (fid, key, x, y)
  fprintf (fid, "%s", key);
  fprintf (fid, ",%.13g", [x y]);
  fprintf (fid, "\n");
endfunction

function sweep (fid, path, key, points)
  fis = readfis (path);
  for p = points'
    [~, ~, ~, mu] = evalfis (p', fis, 101);
    for o = 1 : columns (mu)
      range = fis.output(o).range;
      put (fid, sprintf ("%s,%d", key, o), p', defuzz_all (linspace (range(1), range(2), 101), mu(:, o)'));
    endfor
  endfor
endfunction

function points = grid (a, b)
  [B, A] = meshgrid (b, a);
  points = [A(:) B(:)];
endfunction

% --- membership functions; of dsigmf only where the difference is not negative: MATLAB takes its absolute value,
% the toolkit 0
fid = fopen (fullfile (golden, "mf_octave.csv"), "w");
fprintf (fid, "%s\n# kind,parameters,x,degree\n", how);
kinds = {"trimf", [1 4 6]; "trimf", [-2.5 -1 8]; "trapmf", [1 4 6 9]; "trapmf", [-3 -2 -2 5.5];
         "gaussmf", [2 5]; "gaussmf", [-0.7 3.3]; "gauss2mf", [1 3 3 4]; "gauss2mf", [2 6 1.5 6];
         "gbellmf", [2 4 6]; "gbellmf", [1.5 1 2]; "sigmf", [2 4]; "sigmf", [-0.9 5];
         "dsigmf", [5 2 5 7]; "dsigmf", [-2 7 -2 3]; "psigmf", [2 3 -5 8]; "psigmf", [1 2 -0.5 6];
         "zmf", [3 7]; "zmf", [-1 9]; "smf", [1 8]; "smf", [4 4.5]; "pimf", [1 4 5 10]; "pimf", [0 2 2 3]};
for k = 1 : rows (kinds)
  for x = -1.3 : 0.37 : 11
    fprintf (fid, "%s,%s,%.17g,%.15g\n", kinds{k, 1}, num2str (kinds{k, 2}), x, feval (kinds{k, 1}, x, kinds{k, 2}));
  endfor
endfor
fclose (fid);

% --- surfaces
fid = fopen (fullfile (golden, "surface_octave.csv"), "w");
fprintf (fid, "%s\n# and,or,imp,agg,output,x1,x2,centroid,bisector,mom,som,lom of tests/golden/asym.fis\n", how);
points = grid (linspace (-2, 5, 6), linspace (10, 90, 5));
for method = {"min", "min", "prod", "prod"; "max", "probor", "max", "probor"}
  for imp = {"min", "prod"}
    for agg = {"max", "sum", "probor"}
      words = {"AndMethod", method{1}, "OrMethod", method{2}, "ImpMethod", imp{1}, "AggMethod", agg{1}};
      path = variant (fullfile (golden, "asym.fis"), fullfile (build, "octave.fis"), words{:});
      sweep (fid, path, sprintf ("%s,%s,%s,%s", words{2 : 2 : 8}), points);
    endfor
  endfor
endfor
fclose (fid);

fid = fopen (fullfile (golden, "brake_octave.csv"), "w");
fprintf (fid, "%s\n# and,or,imp,agg,output,x1,x2,centroid,bisector,mom,som,lom of tables/brake.fis and brake_prod.fis\n",
         how);
points = grid (linspace (1, 5, 17), linspace (0, 35, 15));
for imp = {"min", "prod"}
  words = {"AndMethod", imp{1}, "ImpMethod", imp{1}};
  path = variant (fullfile (golden, "../../tables/brake.fis"), fullfile (build, "octave.fis"), words{:});
  sweep (fid, path, sprintf ("%s,max,%s,max", imp{1}, imp{1}), points);
endfor
fclose (fid);

% --- Sugeno: the toolkit's own answer, the rule is the same
fid = fopen (fullfile (golden, "sugeno_octave.csv"), "w");
fprintf (fid, "%s\n# and,or,defuzz,x1,x2,y1,y2 of tests/golden/sugeno.fis\n", how);
points = grid (linspace (-2, 5, 8), linspace (10, 90, 7));
for method = {"min", "prod"; "max", "probor"; "wtaver", "wtsum"}
  path = variant (fullfile (golden, "sugeno.fis"), fullfile (build, "octave.fis"), "AndMethod", method{1}, ...
                  "OrMethod", method{2}, "DefuzzMethod", method{3});
  fis = readfis (path);
  for p = points'
    put (fid, sprintf ("%s,%s,%s", method{:}), p', evalfis (p', fis));
  endfor
endfor
fclose (fid);
