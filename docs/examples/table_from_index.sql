-- The counts of a study from its index alone: sqlite3 -header -column STUDY/index.sqlite < table_from_index.sql
-- Means over the realizations whose fragments mean something (outcome FRAGMENTED, INTACT, TIME_LIMIT).
SELECT 1;
