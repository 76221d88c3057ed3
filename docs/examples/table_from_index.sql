-- The counts of a study from its index alone, also while it is being made:
--   sqlite3 -header -column STUDY/index.sqlite < table_from_index.sql
-- Means and standard deviations are over the realizations of outcome FRAGMENTED (0), INTACT (1) and TIME_LIMIT (2).
WITH usable AS (
    SELECT point, CAST(fragments AS REAL) AS count, dissipated FROM realization WHERE status = 'done' AND outcome <= 2
), mean AS (
    SELECT point, count(*) AS n, avg(count) AS count, avg(dissipated) AS dissipated FROM usable GROUP BY point
), spread AS (
    SELECT point, sqrt(sum((usable.count - mean.count) * (usable.count - mean.count)) / (n - 1)) AS count,
           sqrt(sum((usable.dissipated - mean.dissipated) * (usable.dissipated - mean.dissipated)) / (n - 1))
               AS dissipated
    FROM usable JOIN mean USING (point) GROUP BY point
), progress AS (
    SELECT point, count(*) AS planned, sum(status = 'done') AS done, sum(status IN ('failed', 'quarantined')) AS failed
    FROM realization GROUP BY point
)
SELECT point.hash AS point, planned, done, failed, coalesce(n, 0) AS used,
       mean.count AS count_mean, spread.count AS count_deviation,
       mean.dissipated AS dissipated_mean_J, spread.dissipated AS dissipated_deviation_J
FROM point JOIN progress ON progress.point = point.id
     LEFT JOIN mean ON mean.point = point.id
     LEFT JOIN spread ON spread.point = point.id
ORDER BY point.id;
